/// What the terms of a pair loop share: the particles i in lanes, one particle j, and the sums they add to.
#pragma once

#include "common/sph/kernel.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

/// `lane_count` particles i.
struct Targets {
  VecLanes x, v, v_viscous, grad_rho;
  Lanes rho, p_rho2, eta;
  TensorLanes eta_grad_v;
};

/// The pairs of the particles i with one particle j.
struct Pair {
  VecLanes x_ij, v_ij;
  Lanes r2;       ///< r_ij^2
  Lanes G;        ///< gradW_ij = G x_ij
  Lanes soft_r2;  ///< r_ij^2 + 0.01 h^2
};

/// Sums over j.
struct Rates {
  VecLanes a = zero_vector();  ///< acceleration [m/s2]
  Lanes compression = 0.0;     ///< sum_j V_j v_ij . gradW_ij [1/s]
  Lanes diffusion = 0.0;       ///< [kg/m3/s]
};

template <class W>
TORYU_INLINE Pair make_pair(const W& kernel, const Targets& i, const Sources& source, std::size_t j) {
  Pair pair;
  for (int a = 0; a < dim; ++a) {
    pair.x_ij[a] = i.x[a] - source.x[a][j];
    pair.v_ij[a] = i.v[a] - source.v[a][j];
  }
  pair.r2 = dot(pair.x_ij, pair.x_ij);
  const Lanes safe_r2 = max(pair.r2, 1e-300);  // the particle itself: x_ij = 0 makes its gradient zero
  const Lanes inverse_r = inverse_sqrt(safe_r2);
  pair.G = kernel.gradient_over_r(safe_r2 * inverse_r, inverse_r);
  pair.soft_r2 = pair.r2 + 0.01 * kernel.h() * kernel.h();
  return pair;
}

}  // namespace toryu::fluid
