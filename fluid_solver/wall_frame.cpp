#include "fluid_solver/wall_frame.hpp"

namespace toryu::fluid {

namespace {

bool is_rigid(const Boundary& boundary) {
  return !std::holds_alternative<MovingInterface>(boundary.motion);
}

}  // namespace

bool any_wall_moves(const std::vector<Boundary>& boundaries) {
  for (const Boundary& boundary : boundaries)
    if (is_rigid(boundary) && !std::holds_alternative<Still>(boundary.motion)) return true;
  return false;
}

std::optional<Frame> frame_of_walls(const std::vector<Boundary>& boundaries) {
  Frame frame;
  FrameField wall{"wall", "1", "number of the body, from 0 in the order of fluid.csv", 1, {}},
      velocity{"velocity", "m/s", "", dim, {}};
  double number = 0;
  for (const Boundary& boundary : boundaries) {
    if (!is_rigid(boundary)) continue;
    for (std::size_t k = 0; k < boundary.count; ++k) {
      for (int a = 0; a < dim; ++a) {
        frame.positions.push_back(boundary.x[a][k]);
        velocity.values.push_back(boundary.v[a][k]);
      }
      wall.values.push_back(number);
    }
    ++number;
  }
  if (frame.positions.empty()) return std::nullopt;
  frame.fields = {std::move(wall), std::move(velocity)};
  return frame;
}

}  // namespace toryu::fluid
