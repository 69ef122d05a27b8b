/// Whether an explicit coupling scheme can bear a case: the fluid that a window's motion carries along acts
/// as an added mass, and where that outweighs the solid's surface layer the exchange grows from window to
/// window.
///
///     serial     m_s > (C/2)^2 rho_f dx, but at least 0.37 rho_f dx      C = c_f T/dx, T the window's length
///     parallel   m_s > (C/2)^2 rho_f dx, but at least 0.9 rho_f dx
///
/// The law is that of a mass on a spring of stiffness rho_f c_f^2/dx, integrated explicitly (van Brummelen
/// 2009: in a compressible fluid the added mass is in proportion to the window). The lower bounds are
/// measured with a kernel that reaches 2.5 dx: see cases/pushed_column/added_mass_map.toml. A wider one takes
/// more of the fluid for its wall's neighbour, and the bounds grow in proportion: with 4 dx the parallel
/// scheme is wrong at 1.0 rho_f dx (cases/submerged_beam).
#pragma once

#include <optional>

#include "common/link/participant.hpp"
#include "coupler/parameters.hpp"

namespace toryu {

/// The layer of solid that the fluid had in reach in a window: the mass of the particles that bear `load`
/// over the area of the faces that it presses on (or sucks at), per row of fluid rho_f dx. Dry faces do not
/// count. Nothing if no face is wet.
std::optional<double> layer_mass_ratio(const Interface& interface, const InterfaceLoad& load,
                                       const FluidTraits& fluid);

/// The least such ratio that `scheme` bears with windows of `dt` [s]; 0 for the implicit scheme.
double least_mass_ratio(CouplingScheme scheme, const FluidTraits& fluid, double dt);

/// How to say that a layer is too light: both ratios, and what helps.
std::string too_light(double ratio, double least);

}  // namespace toryu
