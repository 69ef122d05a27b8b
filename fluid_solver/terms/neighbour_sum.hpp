/// The loop of sums over the neighbours j of the particles i in lanes that ask for where j is and for its
/// volume, as gradients and moments do:
///
///     sum_j V_j f_ij gradW_ij
#pragma once

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

/// One particle j as the particles i see it.
struct Neighbour {
  VecLanes x_ij;
  Lanes r;          ///< r_ij
  Lanes G;          ///< gradW_ij = G x_ij
  VecLanes V_grad;  ///< V_j gradW_ij
};

/// Calls `add(j, neighbour)` for all of `sources` near the particles that stand at `x_i`.
template <class W, class Add>
TORYU_INLINE void over_neighbours(const W& kernel, std::span<const ShiftedNeighbours> nears,
                                  const VecLanes& x_i, const Sources& sources, Add&& add) {
  for (const ShiftedNeighbours& near : nears) {
    const VecLanes x = shifted(x_i, near.shift);
    for (const std::uint32_t j : near.sources) {
      const VecLanes x_ij{x[0] - sources.x[0][j], x[1] - sources.x[1][j]};
      const Lanes r2 = max(dot(x_ij, x_ij), 1e-300);  // the particle itself: x_ij = 0 makes its gradient zero
      const Lanes inverse_r = inverse_sqrt(r2), r = r2 * inverse_r;
      const Lanes G = kernel.gradient_over_r(r, inverse_r), V_G = sources.V[j] * G;
      add(j, Neighbour{x_ij, r, G, {V_G * x_ij[0], V_G * x_ij[1]}});
    }
  }
}

/// sum += factor * vector.
TORYU_INLINE void add_product(VecLanes& sum, const Lanes& factor, const VecLanes& vector) {
  for (int a = 0; a < dim; ++a) sum[a] += factor * vector[a];
}

}  // namespace toryu::fluid
