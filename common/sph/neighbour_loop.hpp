/// The one loop over neighbours: the particles i of a cluster in lanes meet the particles j of its lists, one
/// at a time. What sums need of where j is comes with it; what they do not use, the compiler leaves out.
#pragma once

#include <span>

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"

namespace toryu {

/// Where the coordinates of particles lie in memory.
using Positions = std::array<const double*, dim>;

inline Positions pointers(const VecField& field) {
  Positions first{};
  for (int a = 0; a < dim; ++a) first[a] = field[a].data();
  return first;
}

inline std::array<Positions, dim> pointers(const TensorField& field) {
  std::array<Positions, dim> first{};
  for (int a = 0; a < dim; ++a) first[a] = pointers(field[a]);
  return first;
}

/// v_ij = v_i - v_j of any vectors of the particles.
TORYU_INLINE VecLanes difference(const VecLanes& v_i, const Positions& v, std::uint32_t j) {
  VecLanes v_ij;
  for (int a = 0; a < dim; ++a) v_ij[a] = v_i[a] - v[a][j];
  return v_ij;
}

/// One particle j as the particles i see it.
struct Neighbour {
  VecLanes x_ij;
  Lanes r2;  ///< r_ij^2, at least 1e-300: the particle itself has x_ij = 0 and no direction
  Lanes r;
  Lanes G;  ///< gradW_ij = G x_ij

  /// factor gradW_ij; with V_j the gradient that sums over neighbours are made of.
  TORYU_INLINE VecLanes gradient(const Lanes& factor) const { return product(factor * G, x_ij); }
};

/// Calls `add(j, x_ij)` for the particles `sources` at `x`, seen from those that stand at `x_i`.
template <class Add>
TORYU_INLINE void over_sources(std::span<const std::uint32_t> sources, const VecLanes& x_i,
                               const Positions& x, Add&& add) {
  for (const std::uint32_t j : sources) add(j, difference(x_i, x, j));
}

/// The same for all lists of a cluster, each with its shift.
template <class Add>
TORYU_INLINE void over_places(std::span<const ShiftedNeighbours> lists, const VecLanes& x_i,
                              const Positions& x, Add&& add) {
  for (const ShiftedNeighbours& list : lists) over_sources(list.sources, shifted(x_i, list.shift), x, add);
}

/// Calls `add(j, neighbour)` likewise, with distance and kernel.
template <class W, class Add>
TORYU_INLINE void over_neighbours(const W& kernel, std::span<const ShiftedNeighbours> lists,
                                  const VecLanes& x_i, const Positions& x, Add&& add) {
  over_places(lists, x_i, x, [&](std::uint32_t j, const VecLanes& x_ij) TORYU_INLINE_LAMBDA {
    Lanes r2 = 1e-300;
    for (int a = 0; a < dim; ++a) r2 += x_ij[a] * x_ij[a];
    const Lanes inverse_r = inverse_sqrt(r2), r = r2 * inverse_r;
    add(j, Neighbour{x_ij, r2, r, kernel.gradient_over_r(r, inverse_r)});
  });
}

/// sum += factor * vector.
TORYU_INLINE void add_product(VecLanes& sum, const Lanes& factor, const VecLanes& vector) {
  for (int a = 0; a < dim; ++a) sum[a] += factor * vector[a];
}

}  // namespace toryu
