#include "fluid_solver/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace toryu::fluid {

double time_step_edge(const Parameters& p) {
  if (p.integrator == Integrator::symplectic) return 6.7;
  const double delta = p.density_diffusion ? p.density_diffusion->delta : 0.0;
  return std::max(2.6 * std::cbrt(10 * delta), 0.8);
}

std::vector<std::string> beyond_edges(const Parameters& p, double speed) {
  std::vector<std::string> said;
  if (p.time_step_share > time_step_edge(p))
    said.push_back(
        fmt::format("time_step_share {:g} is beyond the edge of stability at {:.2g}; see "
                    "cases/hydrostatic_tank/time_step_map.toml",
                    p.time_step_share, time_step_edge(p)));
  if (p.sound_speed < 10 * speed)
    said.push_back(fmt::format(
        "sound_speed {:g} m/s is below ten times the largest speed at the start, {:.3g} m/s: the density "
        "will change by more than 1 %",
        p.sound_speed, speed));
  return said;
}

}  // namespace toryu::fluid
