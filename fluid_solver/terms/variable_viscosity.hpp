/// Viscosity that differs from particle to particle: the form of laminar_viscosity.hpp with the harmonic mean
/// of a pair, sum_j m_j 2 eta_ij/(rho_i rho_j) x_ij . gradW_ij/(r_ij^2 + 0.01 h^2) v_ij,
///
///     eta_ij = 2 eta_i eta_j/(eta_i + eta_j)
///
/// (Cleary & Monaghan 1999 for conduction). eta_ij = eta_ji, so momentum is kept pair by pair; where eta
/// jumps the stress is continuous. Wall particles have the kernel mean of the fluid's viscosity.
#pragma once

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct VariableViscosityTerm {
  TORYU_INLINE void viscous(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    const Lanes eta_i = i.eta, eta_j = source.eta[j];
    const Lanes factor = (4.0 * source.m[j]) * (eta_i * eta_j) * pair.G * pair.r2 *
                         inverse((eta_i + eta_j) * i.rho * source.rho[j] * pair.soft_r2);
    for (int a = 0; a < dim; ++a) rates.a[a] += factor * (i.v_viscous[a] - source.v_viscous[a][j]);
  }
};

}  // namespace toryu::fluid
