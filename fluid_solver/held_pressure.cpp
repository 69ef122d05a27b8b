#include "fluid_solver/held_pressure.hpp"

#include <algorithm>

namespace toryu::fluid {

double kept_pressure(const std::optional<EnclosedMedium>& medium, const std::vector<Boundary>& boundaries,
                     const EquationOfState& state) {
  if (!medium) return 0;
  std::vector<double> pressures;
  for (const Boundary& boundary : boundaries)
    if (const auto* pressed = std::get_if<PressedMotion>(&boundary.motion))
      pressures.push_back(pressed->press.pressure_at(pressed->time, pressed->area));
  if (pressures.empty()) return 0;
  const auto [least, most] = std::minmax_element(pressures.begin(), pressures.end());
  return 0.5 * (*least + *most) - state.p_b;
}

double pressure_offset(const std::optional<EnclosedMedium>& medium, const Particles& fluid,
                       const std::vector<Boundary>& boundaries, const EquationOfState& state,
                       const Ranks* ranks) {
  if (!medium) return 0;
  if (medium->mean_pressure == 0) return kept_pressure(medium, boundaries, state);
  const auto [volume, sum] = exact_sums<2>(fluid, ranks, [&](std::size_t i) {
    const double V_i = fluid.m[i] / fluid.rho[i];
    return std::array{V_i, V_i * state.pressure(fluid.rho[i])};
  });
  return medium->mean_pressure - sum / volume;
}

}  // namespace toryu::fluid
