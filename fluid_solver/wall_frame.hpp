/// The rigid walls as they are drawn beside the fluid.
#pragma once

#include <optional>
#include <vector>

#include "common/run/solver.hpp"
#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

/// The particles of all rigid walls, body by body as fluid.csv has them; none of a fluid without walls. The
/// solid draws itself.
std::optional<Frame> frame_of_walls(const std::vector<Boundary>& boundaries);
/// Whether any of them may move.
bool any_wall_moves(const std::vector<Boundary>& boundaries);

}  // namespace toryu::fluid
