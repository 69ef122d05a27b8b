#include "common/scene/rows.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace toryu {

double value_in(const Rows& rows, double at, std::size_t column) {
  if (rows.empty()) return 0;
  const auto beyond = [](double place, const std::vector<double>& row) { return place < row[0]; };
  const auto next = std::upper_bound(rows.begin(), rows.end(), at, beyond);
  if (next == rows.begin()) return rows.front()[column];
  const auto& last = *std::prev(next);
  if (next == rows.end()) return last[column];
  const double share = (at - last[0]) / ((*next)[0] - last[0]);
  return last[column] + share * ((*next)[column] - last[column]);
}

void require_rising(ParameterTable& table, const std::string& key, const Rows& rows,
                    const std::string& what) {
  for (std::size_t k = 1; k < rows.size(); ++k)
    table.require(
        rows[k][0] > rows[k - 1][0], key,
        fmt::format("{} in '{}' must increase: {} comes after {}", what, key, rows[k][0], rows[k - 1][0]));
}

}  // namespace toryu
