/// Generalised Newtonian media: the viscosity eta [Pa s] as a function of the shear rate gdot [1/s].
///
///     power law:  eta = m gdot^(n-1), kept between two bounds        (Ostwald 1925, de Waele 1923)
///     Carreau:    eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda gdot)^2)^((n-1)/2)  (Carreau 1972)
///
/// n < 1 thins under shear, n = 1 is Newtonian, n > 1 thickens. Media of abrasive flow machining thin, at 10
/// to 1e4 Pa s. Without bounds the power law's viscosity at rest would be infinite (n < 1) or zero (n > 1):
/// the bounds stand for the plateaus that real media have, and the largest limits the time step.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/sph/lanes.hpp"
#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

inline double viscosity(const PowerLaw& law, double shear_rate) {
  return std::clamp(law.consistency * std::pow(shear_rate, law.exponent - 1), law.smallest_viscosity,
                    law.largest_viscosity);
}

inline double viscosity(const Carreau& law, double shear_rate) {
  const double lambda_gdot = law.relaxation_time * shear_rate;
  return law.infinite_shear_viscosity + (law.zero_shear_viscosity - law.infinite_shear_viscosity) *
                                            std::pow(1 + lambda_gdot * lambda_gdot, 0.5 * (law.exponent - 1));
}

/// Lane by lane: once a particle, not once a pair.
Lanes viscosity(const auto& law, const Lanes& shear_rate) {
  Lanes eta;
  for (std::size_t lane = 0; lane < lane_count; ++lane) eta.value[lane] = viscosity(law, shear_rate[lane]);
  return eta;
}

}  // namespace toryu::fluid
