/// What the terms of a pair loop share: the particles i in lanes, one particle j, and the sums they add to.
#pragma once

#include "common/sph/neighbour_loop.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

/// `lane_count` particles i.
struct Targets {
  VecLanes x, v, v_viscous, grad_rho;
  Lanes rho, p_rho2, eta;
  TensorLanes eta_grad_v;
};

/// The pairs of the particles i with one particle j.
struct Pair : Neighbour {
  VecLanes v_ij;
  Lanes soft_r2;  ///< r_ij^2 + 0.01 h^2
};

/// Sums over j.
struct Rates {
  VecLanes a = zero_vector();  ///< acceleration [m/s2]
  Lanes compression = 0.0;     ///< sum_j V_j v_ij . gradW_ij [1/s]
  Lanes diffusion = 0.0;       ///< [kg/m3/s]
};

template <class W>
TORYU_INLINE Pair make_pair(const W& kernel, const Neighbour& n, const Targets& i, const Sources& source,
                            std::size_t j) {
  Pair pair{n, {}, n.r2 + 0.01 * kernel.h() * kernel.h()};
  for (int a = 0; a < dim; ++a) pair.v_ij[a] = i.v[a] - source.v[a][j];
  return pair;
}

}  // namespace toryu::fluid
