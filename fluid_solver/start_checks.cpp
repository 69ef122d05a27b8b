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

namespace {

std::vector<StartFault> level_faults(const Parameters& p, const Vec& gravity) {
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

/// Pressures beyond which a press compresses or stretches the whole fluid by more than the limits allow: of
/// an enclosed medium by how much they differ, for what holds it moves nothing.
std::vector<StartFault> press_faults(const Parameters& p, const Scene& scene) {
  const EquationOfState state{p.density, p.sound_speed, p.stiffness_exponent,
                              p.background_pressure ? p.background_pressure->pressure : 0.0};
  const double change = std::min(p.limits.largest_density_change, p.limits.largest_mean_density_change);
  const double least = state.pressure(p.density * (1 - change)),
               most = state.pressure(p.density * (1 + change));
  const auto pressure = [&](const Wall& wall, double time) {
    return wall.press->pressure_at(time, pressing_area(wall, scene.geometry));
  };
  std::vector<StartFault> faults;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const Wall& wall = scene.walls[k];
    if (!wall.press) continue;
    for (const auto& row : wall.press->force.empty() ? wall.press->pressure : wall.press->force) {
      const double given = pressure(wall, row[0]);
      double held = 0;
      if (p.enclosed_medium) {
        double low = given, high = given;
        for (const Wall& other : scene.walls)
          if (other.press) {
            low = std::min(low, pressure(other, row[0]));
            high = std::max(high, pressure(other, row[0]));
          }
        held = 0.5 * (low + high) - state.p_b;
      }
      if (given - held >= least && given - held <= most) continue;
      faults.push_back(
          {fmt::format("wall.{}.press.{}", k, wall.press->force.empty() ? "pressure" : "force"),
           fmt::format(
               "the press '{}' is at {:.4g} Pa at t = {:g} s: by that the density would change by more than "
               "{:g} %; 1 % takes a 'sound_speed' of {:.3g} m/s, and a medium without free surface may be an "
               "[fluid.enclosed_medium]",
               wall.name, given, row[0], 100 * change, 10 * std::sqrt(std::abs(given - held) / p.density))});
      break;
    }
  }
  return faults;
}

}  // namespace

std::vector<StartFault> start_faults(const Parameters& p, const Scene& scene) {
  std::vector<StartFault> faults = level_faults(p, scene.gravity_at(0)), of_presses = press_faults(p, scene);
  faults.insert(faults.end(), of_presses.begin(), of_presses.end());
  return faults;
}

}  // namespace toryu::fluid
