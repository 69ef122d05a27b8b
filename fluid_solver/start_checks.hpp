/// Starts that cannot be: what is wrong with the case itself is told before any particle shows it.
#pragma once

#include <string>
#include <vector>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

/// A fault of the case: the key that it belongs to, and what is wrong.
struct StartFault {
  std::string key, message;
};

/// Heights against gravity between which there is fluid at the start [m].
struct Heights {
  double lowest = 0, highest = 0;
};
Heights heights(const std::vector<Region>& regions, const Vec& gravity);

/// Density of fluid at rest, `depth` [m] below a surface without pressure: the weight of a column whose
/// density follows from its own pressure. NaN above the height at which such a fluid ends [kg/m3].
double density_at_depth(const Parameters& parameters, double g, double depth);

/// A level of the surface below all fluid; a sound speed at which fluid so deep is denser than the limits
/// allow; presses whose pressure changes the density by more than they allow.
std::vector<StartFault> start_faults(const Parameters& parameters, const Scene& scene);

}  // namespace toryu::fluid
