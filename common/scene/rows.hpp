/// Tables in a case: a place or a time, and what is there.
#pragma once

#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"

namespace toryu {

using Rows = std::vector<std::vector<double>>;

/// A column, the second one unless said, where the first is `at`: linear between the rows, constant beyond
/// them; 0 without rows.
double value_in(const Rows& rows, double at, std::size_t column = 1);

/// Requires that the first column of `key`, which has `what` ("times"), rises from row to row.
void require_rising(ParameterTable& table, const std::string& key, const Rows& rows, const std::string& what);

}  // namespace toryu
