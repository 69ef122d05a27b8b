/// Walls that nothing makes the solid touch: it passes through them without a force.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu::solid {

class PassedWalls {
 public:
  /// `X` [m] is where the particles are at the start; those that a wall holds then belong there. One is in a
  /// wall where its cell is, of a side of `spacing` [m]: rows beside a round face stand nearer than half of
  /// it.
  PassedWalls(const std::vector<Wall>& walls, const std::vector<Vec>& X, double spacing);
  /// Warns of the first of the particles at `x` [m] that is in a wall at `time` [s]; but once in a run.
  void check(const std::vector<Vec>& x, double time);

 private:
  std::vector<Wall> walls_;
  double spacing_;
  std::vector<std::uint32_t> free_;  ///< numbers of the particles that no wall holds at the start
};

}  // namespace toryu::solid
