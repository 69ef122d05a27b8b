/// Laminar viscosity (Morris, Fox & Zhu 1997): sum_j m_j 2 mu/(rho_i rho_j) x_ij . gradW_ij/(r_ij^2 + 0.01
/// h^2) v_ij, the divergence of the viscous stress (4) of a nearly incompressible fluid in a form that needs
/// no velocity gradient, sees the velocity v_w-f at walls (28) and is equal and opposite pair by pair.
#pragma once

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct LaminarViscosityTerm {
  double mu;

  TORYU_INLINE void viscous(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    const Lanes factor =
        (2.0 * mu * source.m[j]) * pair.G * pair.r2 * inverse(i.rho * source.rho[j] * pair.soft_r2);
    for (int a = 0; a < dim; ++a) rates.a[a] += factor * (i.v_viscous[a] - source.v_viscous[a][j]);
  }
};

}  // namespace toryu::fluid
