/// Renormalised density gradient (20)-(21) over fluid particles (Randles & Libersky 1996):
///
///     <grad rho>_i = L_i sum_j V_j (rho_j - rho_i) gradW_ij
///
/// Where L_i is near singular (few neighbours, one-sided) the gradient is left out, that is zero.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "fluid_solver/terms/renormalisation.hpp"

namespace toryu::fluid {

template <class W>
VecLanes density_gradient(const Particles& f, const W& kernel, std::size_t first,
                          std::span<const Near> neighbours) {
  const Lanes rho_i = load(f.rho, first);
  Moment moment;
  VecLanes b = zero_vector();
  for (const Near& near : neighbours) {
    const VecLanes x_i = shifted(load(f.x, first), near.shift);
    for (const std::uint32_t j : near.sources) {
      const VecLanes x_ij{x_i[0] - f.x[0][j], x_i[1] - f.x[1][j]};
      const Lanes r2 = max(dot(x_ij, x_ij), 1e-300);
      const Lanes inverse_r = inverse_sqrt(r2);
      const Lanes V_G = f.V[j] * kernel.gradient_over_r(r2 * inverse_r, inverse_r);
      const VecLanes V_grad{V_G * x_ij[0], V_G * x_ij[1]};
      moment.add(x_ij, V_grad);
      const Lanes rho_ji = f.rho[j] - rho_i;
      for (int a = 0; a < dim; ++a) b[a] += rho_ji * V_grad[a];
    }
  }
  moment.invert();
  return moment.renormalised(b);
}

}  // namespace toryu::fluid
