/// Gravity that changes: as a tank feels it that is shaken or tilted.
#pragma once

#include <optional>
#include <vector>

#include "common/scene/motion.hpp"

namespace toryu {

/// An acceleration that swings [m/s2].
struct Shake : DirectedSine {};
void describe(ParameterTable& table, Shake& shake);

/// What is added to gravity over time, and the angle by which the sum is turned:
///
///     g(t) = R(angle(t)) (g + sum of all that is added)
///
/// In a frame that moves by a(t) without turning, adding -a(t) is exact. A frame that turns has more forces
/// than these (centrifugal, Euler's, Coriolis's): there the walls are to turn instead.
struct GravityChange {
  Rows acceleration = {};  ///< rows of time [s], a_x, a_y [m/s2]; linear in between, constant beyond
  std::vector<Shake> sine = {};
  std::optional<Turning> turning = {};
  Vec at(const Vec& gravity, double t) const;  ///< [m/s2]
};
void describe(ParameterTable& table, GravityChange& change);

}  // namespace toryu
