#include "coupler/added_mass.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "coupler/exchange_audit.hpp"

namespace toryu {

double layer_mass_ratio(const Interface& interface, const FluidTraits& fluid) {
  const double mass = std::reduce(interface.mass.begin(), interface.mass.end());
  const double area = sum_of_lengths(interface.area_vector), unit = fluid.density * fluid.spacing;
  return area > 0 && unit > 0 ? mass / area / unit : std::numeric_limits<double>::infinity();
}

double least_mass_ratio(CouplingScheme scheme, const FluidTraits& fluid, double dt) {
  const double courant = fluid.spacing > 0 ? fluid.sound_speed * dt / fluid.spacing : 0.0;
  switch (scheme) {
    case CouplingScheme::serial_explicit:
      return std::max(0.37, 0.25 * courant * courant);
    case CouplingScheme::parallel_explicit:
      return std::max(0.9, 0.25 * courant * courant);
    default:
      return 0.0;
  }
}

}  // namespace toryu
