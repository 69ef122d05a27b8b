/// Viscosity that differs from particle to particle: the divergence of the stress eta (grad v + grad v^T) in
/// two parts, both equal and opposite pair by pair:
///
///     sum_j m_j 2 eta_ij/(rho_i rho_j) x_ij . gradW_ij/r_ij^2 v_ij,
///     eta_ij = 2 eta_i eta_j/(eta_i + eta_j)
///
/// is div(eta grad v), laminar_viscosity.hpp with the harmonic mean of a pair (Cleary & Monaghan 1999 for
/// conduction): where eta jumps the stress is continuous. And
///
///     sum_j m_j/(rho_i rho_j) [(eta grad v)_i + (eta grad v)_j] . gradW_ij
///
/// is div(eta grad v^T), which is grad eta . grad v^T where the flow keeps its volume: nothing in a Newtonian
/// medium and in a straight channel, but half of the force where a flow that stretches meets a gradient of
/// viscosity. Without it a medium that turns as a whole would feel a force.
///
/// Wall particles have the kernel means of the fluid's eta and eta grad v.
#pragma once

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct VariableViscosityTerm {
  TORYU_INLINE void viscous(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    const Lanes eta_i = i.eta, eta_j = source.eta[j];
    const Lanes along_x = inverse(i.rho) * pair.V_G;  // V_j = m_j/rho_j
    const Lanes along_v = (4.0 * eta_i * eta_j) * inverse(eta_i + eta_j) * along_x;
    for (int a = 0; a < dim; ++a) {
      Lanes T_x = 0.0;
      for (int b = 0; b < dim; ++b) T_x += (i.eta_grad_v[a][b] + source.eta_grad_v[a][b][j]) * pair.x_ij[b];
      rates.a[a] += along_v * pair.v_viscous_ij[a] + along_x * T_x;
    }
  }
};

}  // namespace toryu::fluid
