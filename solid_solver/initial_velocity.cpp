#include "solid_solver/initial_velocity.hpp"

#include <cmath>

namespace toryu {

Vec InitialVelocity::at(const Vec& X) const {
  if (profile == VelocityProfile::uniform) return velocity;
  const double x = X[0] - origin[0];
  if (x <= 0) return Vec::Zero();
  const double kL = 1.8751041, k = kL / length;
  const auto F = [&](double s) {
    return (std::cos(kL) + std::cosh(kL)) * (std::cosh(k * s) - std::cos(k * s)) +
           (std::sin(kL) - std::sinh(kL)) * (std::sinh(k * s) - std::sin(k * s));
  };
  return velocity * (F(x) / F(length));
}

void describe(ParameterTable& table, InitialVelocity& v) {
  table.choice("profile", v.profile, {"uniform", "cantilever_mode_1"},
               {.help = "the same everywhere, or the first bending mode of a beam along x"});
  table.vector("velocity", v.velocity,
               {.unit = "m/s", .required = true, .help = "of all particles, or of the tip of the beam"});
  table.vector("origin", v.origin, {.unit = "m", .help = "where the beam is held"});
  table.number("length", v.length, {.unit = "m", .minimum = 0, .above_minimum = true, .help = "of the beam"});
}

}  // namespace toryu
