/// What a case file comes to, for other programs: the launcher, the report and the studies read no case
/// themselves.
#pragma once

#include <string>

#include "common/case/case_file.hpp"

namespace toryu {

/// JSON: `case`, as CaseFile::resolved gives it, and `references`, each with what the case says of it and
/// either its `points` (rows of time [s] and value) or its `fault`; `files`, all that the case names;
/// `shapes` of all bodies as they come to lie in the scene: the `list` in which they stand, their `number` in
/// it, their `name`, whether they are an outline, and `rings` of corners [m]; and `motions` of walls: the
/// number of the `wall`, and `poses`, rows of time [s], place of the point `about` [m], angle [rad], velocity
/// of the point [m/s]. Throws BadInput with the faults of the overrides.
std::string resolved_case(CaseFile& file);

}  // namespace toryu
