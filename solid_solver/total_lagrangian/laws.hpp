/// The laws of the total Lagrangian form. Each has, for a displacement gradient H:
///
///     stress(H)            P [Pa], of numbers or of lanes
///     stress_across(H)     P_zz [Pa]
///     energy(H)            per reference volume [J/m3]
///     longitudinal_modulus(l_1^2, l_2^2)   d2psi/dl_1^2 [Pa], what waves along that principal direction feel
#pragma once

#include <variant>

#include "common/run/solver.hpp"
#include "solid_solver/parameters.hpp"
#include "solid_solver/terms/neo_hookean.hpp"
#include "solid_solver/terms/saint_venant_kirchhoff.hpp"
#include "solid_solver/terms/yeoh.hpp"

namespace toryu::solid {

using Law = std::variant<SaintVenantKirchhoff, NeoHookean, Yeoh>;

Law law_of(const Material& material);
ActiveTerm active_law(const Material& of);

}  // namespace toryu::solid
