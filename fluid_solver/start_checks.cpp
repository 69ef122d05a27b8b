#include "fluid_solver/start_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace toryu::fluid {

Heights heights(const std::vector<Region>& regions, const Vec& gravity) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Heights found{infinity, -infinity};
  const Vec up = -gravity.normalized();
  for (const auto& region : regions) {
    const double middle = 0.5 * up.dot(region.box.min + region.box.max);
    const double half = 0.5 * up.cwiseAbs().dot(region.box.max - region.box.min);
    found.lowest = std::min(found.lowest, middle - half);
    found.highest = std::max(found.highest, middle + half);
  }
  return found;
}

double density_at_depth(const Parameters& p, double g, double depth) {
  const double c_02 = p.sound_speed * p.sound_speed, n = p.stiffness_exponent - 1.0;
  return p.density * (n > 0 ? std::pow(1.0 + n * g * depth / c_02, 1.0 / n) : std::exp(g * depth / c_02));
}

std::vector<StartFault> start_faults(const Parameters& p, const Vec& gravity) {
  const double g = gravity.norm();
  if (!p.hydrostatic_start || g == 0) return {};
  const double level = p.hydrostatic_start->surface_level;
  const auto [lowest, highest] = heights(p.regions, gravity);
  if (level <= lowest)
    return {
        {"fluid.hydrostatic_start.surface_level",
         fmt::format("'surface_level' {:g} m lies below all of the fluid, which reaches from {:g} to {:g} m "
                     "against gravity",
                     level, lowest, highest)}};
  const double depth = level - lowest, rho = density_at_depth(p, g, depth);
  const double most = p.density * (1 + p.limits.largest_density_change);
  if (rho <= most) return {};
  return {
      {"fluid.sound_speed",
       fmt::format("'sound_speed' {:g} m/s is too low for fluid at rest {:.3g} m deep: its density would be "
                   "{:.6g} kg/m3 at the bottom, at most {:.6g} are allowed; ten times the speed of a fall "
                   "through that depth is {:.3g} m/s",
                   p.sound_speed, depth, rho, most, 10 * std::sqrt(2 * g * depth))}};
}

}  // namespace toryu::fluid
