#include "fluid_solver/suction_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/counted.hpp"

namespace toryu::fluid {

namespace {

/// Spacings: particles have paired by then, and where a suction is lost in cases/retreating_piston the 16
/// longest paths end at 6.8 to 8.7.
constexpr double longest_path = 5;

/// A single drop may be under suction for ever.
std::size_t least_paired(std::size_t count) {
  return std::max<std::size_t>(16, count / 100);
}

}  // namespace

std::optional<std::string> SuctionWatch::look(const Particles& fluid, double time) {
  const double dt = time - state_.time;
  state_.time = time;
  state_.path.resize(fluid.count);
  std::size_t paired = 0;
  double lowest = 0;
  const double rho_without_pressure = equation_of_state_.density(0);
  for (std::size_t i = 0; i < fluid.count; ++i) {
    if (fluid.id[i] >= state_.path.size()) state_.path.resize(fluid.id[i] + 1);  // it came in at an open end
    double& path = state_.path[fluid.id[i]];
    if (path == 0 && fluid.rho[i] >= rho_without_pressure) continue;  // nearly all of a medium that is well
    const double p = !fluid.off_surface_and_walls.empty() && fluid.off_surface_and_walls[i] > 0
                         ? 0.0
                         : equation_of_state_.pressure(fluid.rho[i]);
    const double step = std::min(std::sqrt(std::abs(p) / fluid.rho[i]) * dt / spacing_, 1.0);
    path = std::max(path - std::copysign(step, p), 0.0);
    if (path < longest_path) continue;
    ++paired;
    lowest = std::min(lowest, p);
  }
  if (paired < least_paired(fluid.count)) return {};
  return fmt::format(
      "t = {:.3g} s: {} of the fluid {} long been under suction, now of up to {:.3g} Pa: they "
      "pair, and what has paired transmits none; take a higher [fluid.background_pressure] or "
      "[fluid.particle_shifting], see cases/retreating_piston/suction_map.toml",
      time, counted(paired, "particle"), paired == 1 ? "has" : "have", -lowest);
}

}  // namespace toryu::fluid
