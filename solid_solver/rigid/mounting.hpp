/// What holds a rigid body: degrees of freedom that are fixed, springs and dampers against the ground. They
/// act at the body's point of reference, its centre of mass or the pivot.
///
///     F = -k (x - rest) - c dx/dt along each axis,   M = -k_a (theta - rest_angle) - c_a dtheta/dt
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"

namespace toryu::solid {

static_assert(dim == 2, "one angle");

/// x, y and the angle of a rigid body, or what belongs to them.
using Coordinates = Eigen::Matrix<double, dim + 1, 1>;
/// Their names, as a case has them.
inline const std::vector<std::string> coordinate_names{"x", "y", "angle"};

struct Mounting {
  std::vector<std::string> fixed = {};  ///< names of coordinates that stay as they are
  /// The point that stays, of a body of which x and y are fixed [m]; none: the centre of mass.
  Vec pivot = Vec::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec stiffness = Vec::Zero();   ///< [N/m per metre depth]
  Vec damping = Vec::Zero();     ///< [N.s/m per metre depth]
  Vec rest = Vec::Zero();        ///< displacement at which the springs bear nothing [m]
  double angular_stiffness = 0;  ///< [N.m/rad per metre depth]
  double angular_damping = 0;    ///< [N.m.s/rad per metre depth]
  double rest_angle = 0;         ///< [rad]

  bool has_pivot() const { return pivot.allFinite(); }
  bool is_fixed(int coordinate) const;
  Coordinates stiffnesses() const { return {stiffness[0], stiffness[1], angular_stiffness}; }
  Coordinates dampings() const { return {damping[0], damping[1], angular_damping}; }
  Coordinates rests() const { return {rest[0], rest[1], rest_angle}; }
};
void describe(ParameterTable& table, Mounting& mounting);

}  // namespace toryu::solid
