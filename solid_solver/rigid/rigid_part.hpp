/// One of the rigid bodies of a solid, apart from its motion: what belongs to it, what holds it, what it
/// weighs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/run/solver.hpp"
#include "common/scene/motion.hpp"
#include "solid_solver/body.hpp"

namespace toryu::solid {

/// A force at the end of an arm, as it drives the coordinates.
inline Coordinates at_arm(const Vec& arm, const Vec& force) {
  return {force[0], force[1], cross(arm, force)};
}

struct RigidPart {
  /// `particles` of `body`, held by `mounting` if there is one.
  RigidPart(const Body& body, std::vector<std::uint32_t> particles, const std::optional<Mounting>& mounting,
            std::string name);

  /// Where it is with the coordinates q and their rates v.
  Pose pose(const Coordinates& q, const Coordinates& v) const;
  Coordinates natural_frequencies() const;           ///< by the springs, undamped [rad/s]
  double spring_energy(const Coordinates& q) const;  ///< [J/m]
  std::string prefix() const { return name.empty() ? "" : name + ": "; }
  void append_terms(std::vector<ActiveTerm>& terms) const;

  std::string name;  ///< none of a body that is the only one
  std::vector<std::uint32_t> particles;
  Mounting mounting;
  bool mounted;                               ///< whether the case has a mounting
  Coordinates free = Coordinates::Ones();     ///< 0 where fixed, else 1
  Vec reference = Vec::Zero();                ///< in the unloaded body [m]
  Coordinates inertia = Coordinates::Zero();  ///< m, m [kg/m], I [kg.m2/m]
};

/// All of a solid, in the order of `parameters.bodies`, or the one that it is.
std::vector<RigidPart> rigid_parts(const Parameters& parameters, const Body& body);

}  // namespace toryu::solid
