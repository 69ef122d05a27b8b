#include "solid_solver/guards.hpp"

#include <fmt/format.h>

#include <cmath>

namespace toryu {

namespace {

/// Artificial stress above this feeds the sliding of rows more than viscosity stops it.
constexpr double most_epsilon = 0.5;

void guard_artificial_stress(const SolidParameters& p, std::vector<std::string>& said) {
  const double epsilon = p.artificial_stress ? p.artificial_stress->epsilon : 0.0;
  const int exponent = p.artificial_stress ? p.artificial_stress->exponent : 4;
  const double least = least_epsilon(p.smoothing_ratio, exponent);
  if (epsilon < least)
    said.push_back(
        fmt::format("artificial stress of epsilon {:g} is below the {:.2g} that keeps a stretched body from "
                    "tearing by itself; see cases/stretched_bar/tensile_map.toml",
                    epsilon, least));
  if (epsilon > most_epsilon)
    said.push_back(
        fmt::format("artificial stress of epsilon {:g} is above the {:g} from which particles under tension "
                    "slide into another arrangement; see cases/stretched_bar/tensile_window_map.toml",
                    epsilon, most_epsilon));
}

}  // namespace

double courant_edge(const SolidParameters& p) {
  if (p.integrator == Integrator::symplectic) return 1.87;
  return p.artificial_viscosity ? 1.1 * std::cbrt(p.artificial_viscosity->alpha) : 0.0;
}

std::vector<std::string> beyond_edges(const SolidParameters& p) {
  std::vector<std::string> said;
  if (p.formulation != Formulation::updated_lagrangian) return said;
  guard_artificial_stress(p, said);
  const double edge = courant_edge(p), courant = p.time_step_share * p.courant_number;
  if (edge == 0 && !p.damping)
    said.push_back(
        "nothing damps the solid, and midpoint steps amplify what is not damped by (omega dt)^4/8 each: give "
        "it [solid.artificial_viscosity] or integrator = \"symplectic\"; see "
        "cases/oscillating_plate/time_step_map.toml");
  else if (courant > edge && !p.damping)
    said.push_back(
        fmt::format("courant_number times time_step_share is {:.3g}, beyond the edge of stability at {:.3g}; "
                    "see cases/oscillating_plate/time_step_map.toml",
                    courant, edge));
  return said;
}

}  // namespace toryu
