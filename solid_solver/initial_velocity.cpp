#include "solid_solver/initial_velocity.hpp"

#include <cmath>
#include <numbers>

namespace toryu::solid {

Vec InitialVelocity::at(const Vec& X) const {
  if (profile == VelocityProfile::uniform) return velocity;
  if (profile == VelocityProfile::linear) {
    Vec v = velocity;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b) v[a] += gradient[a][b] * (X - origin)[b];
    return v;
  }
  if (profile == VelocityProfile::alternating) {
    const Vec square = ((X - origin) / length).array().floor();
    return std::remainder(square.sum(), 2.0) == 0 ? velocity : Vec(-velocity);
  }
  const double x = X[0] - origin[0];
  if (x <= 0) return Vec::Zero();
  if (profile == VelocityProfile::bar_mode_1) return velocity * std::sin(0.5 * std::numbers::pi * x / length);
  const double kL = 1.8751041, k = kL / length;
  const auto F = [&](double s) {
    return (std::cos(kL) + std::cosh(kL)) * (std::cosh(k * s) - std::cos(k * s)) +
           (std::sin(kL) - std::sinh(kL)) * (std::sinh(k * s) - std::sin(k * s));
  };
  return velocity * (F(x) / F(length));
}

bool InitialVelocity::is_rigid() const {
  if (profile != VelocityProfile::linear) return profile == VelocityProfile::uniform;
  return gradient.size() == dim && gradient[0][0] == 0 && gradient[1][1] == 0 &&
         gradient[0][1] == -gradient[1][0];
}

void describe(ParameterTable& table, InitialVelocity& v) {
  table.choice(
      "profile", v.profile, {"uniform", "cantilever_mode_1", "linear", "bar_mode_1", "alternating"},
      {.help = "the same everywhere, the first bending mode of a beam along x, growing linearly, the first "
               "longitudinal mode of a bar along x, or changing sign from square to square"});
  table.vector("velocity", v.velocity,
               {.unit = "m/s",
                .required = true,
                .help = "of all particles, of the tip of the beam or bar, or at the origin"});
  table.vector("origin", v.origin, {.unit = "m", .help = "where the beam or bar is held, or v = velocity"});
  table.number(
      "length", v.length,
      {.unit = "m", .minimum = 0, .above_minimum = true, .help = "of the beam or bar, or of a square"});
  table.rows("gradient", v.gradient, {"d/dx [1/s]", "d/dy [1/s]"}, {.help = "linear: of v_x, then of v_y"});
  table.require(v.profile != VelocityProfile::linear || v.gradient.size() == dim, "gradient",
                "profile = \"linear\" needs 'gradient', a row for v_x and one for v_y");
}

}  // namespace toryu::solid
