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
  Symmetric<Lanes> polymer_stress;
};

/// The pairs of the particles i with one particle j.
struct Pair : Neighbour {
  VecLanes v_ij, v_viscous_ij;
  Lanes V_G;      ///< V_j G
  Lanes soft_r2;  ///< r_ij^2 + 0.01 h^2
};

/// Whose pairs they are: of walls v_viscous is not v.
enum class PairsOf { fluid, fluid_and_wall };

/// Sums over j.
struct Rates {
  VecLanes a = zero_vector();  ///< acceleration [m/s2]
  Lanes compression = 0.0;     ///< sum_j V_j v_ij . gradW_ij [1/s]
  Lanes diffusion = 0.0;       ///< [kg/m3/s]
  Lanes push = -0.0;           ///< of the pair at hand: P_ij of - sum_j m_j P_ij gradW_ij [m5/(kg s2)]

  /// Adds what the terms have put together of `push`, once for all of them. The next pair begins at -0, to
  /// which the compiler adds nothing.
  TORYU_INLINE void close(const Pair& pair, double m_j) {
    const Lanes factor = (m_j * pair.G) * push;
    for (int k = 0; k < dim; ++k) a[k] -= factor * pair.x_ij[k];
    push = -0.0;
  }
};

template <PairsOf pairs = PairsOf::fluid_and_wall, class W>
TORYU_INLINE Pair make_pair(const W& kernel, const Neighbour& n, const Targets& i, const Sources& source,
                            std::uint32_t j) {
  const VecLanes v_ij = difference(i.v, source.v, j);
  return {n, v_ij, pairs == PairsOf::fluid ? v_ij : difference(i.v_viscous, source.v_viscous, j),
          source.V[j] * n.G, n.r2 + 0.01 * kernel.h() * kernel.h()};
}

}  // namespace toryu::fluid
