/// Stability warnings: what lies beyond an edge of stability that a map has found is said when a case is
/// checked, with the name of the map.
#pragma once

#include <string>
#include <vector>

#include "common/case/case_file.hpp"
#include "coupler/parameters.hpp"

namespace toryu::coupling {

/// A sentence for each edge that a case lies beyond. The added mass is estimated from what the case says of
/// the fluid and of the solid, whoever plays them: the thinnest of the solid's regions, wet on one side. What
/// it really is shows when they meet (added_mass.hpp).
std::vector<std::string> stability_warnings(const CaseFile& file, const Parameters& coupling);

}  // namespace toryu::coupling
