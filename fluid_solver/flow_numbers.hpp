/// The dimensionless numbers of a viscous case, told by --check --outlook before the run:
///
///     Re = rho U w/eta,   Ma = U/c_0,   Wi_k = lambda_k gdot_w
///
/// with the mean speed U in the fluid's width w and eta and the rate of shear gdot_w at the wall, of the
/// developed flow of similarity.hpp. The polymer of mode k adds its viscosity in steady shear. U is that of
/// the walls or, where space repeats and nothing else drives, what gravity makes of it: tau_w = rho g w/2,
/// about an axis rho g w/4.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.hpp"
#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

struct FlowNumbers {
  double speed = 0, width = 0;  ///< U [m/s], w [m]
  double reynolds = 0, mach = 0;
  std::vector<double> weissenberg = {};  ///< a mode each
};

/// Nothing without a viscosity, or where neither walls nor gravity say how fast it flows.
std::optional<FlowNumbers> flow_numbers(const Parameters& parameters, const Scene& scene);

/// As --check tells them.
std::string text(const FlowNumbers& numbers);

}  // namespace toryu::fluid
