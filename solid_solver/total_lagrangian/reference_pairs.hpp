/// The pairs of the unloaded body, found once: weights, shapes, and the two sums over pairs of which the
/// total Lagrangian form consists. Nothing here knows a material.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/neighbour_loop.hpp"
#include "common/sph/points.hpp"
#include "common/sph/tensor.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the sums and the inverse have the components of the plane");

class ReferencePairs {
 public:
  /// X [m] in strip order of strips `strip_width` [m] wide, volume [m2]; both padded to whole lanes.
  ReferencePairs(const VecField& X, const Field& volume, std::size_t count, double h, double strip_width);

  /// Displacement gradient, renormalised, so that it is exact for linear u (Randles & Libersky 1996):
  ///
  ///     H_i = sum_j V_j (u_j - u_i) (x) L_i gradW_ij,   L_i = [sum_j V_j (X_j - X_i) (x) gradW_ij]^-1
  void displacement_gradient(const VecField& u, std::size_t cluster, Tensor<Lanes>& H) const;

  /// f_i/V_i = sum_j V_j [(T_i + T_j) gradW_ij + k (u_i - u_j) W'_ij/R_ij]: equal and opposite for a pair.
  /// T [Pa] is any tensor of a particle, k [Pa] the stiffness of the pair penalty.
  VecLanes force_density(const VecField& u, const Tensor<Field>& T, double k, std::size_t cluster) const;

  /// sum_j V_j g(x_ij, v_ij) x_ij W'_ij/R_ij: central forces between present positions, for viscosity.
  template <class Central>
  VecLanes central_force_density(const VecField& u, const VecField& v, std::size_t cluster,
                                 Central&& g) const;

  /// sum_j V_j |u_ij - H_i X_ij|^2 (-W'_ij/R_ij) [1]: what H_i does not see.
  Lanes unseen_motion(const VecField& u, const Tensor<Field>& H, std::size_t cluster) const;

  Tensor<Lanes> shape(std::size_t cluster) const;  ///< L

 private:
  /// Calls add(j, V_j W'_ij/R_ij, X_ij) for the sources of a cluster.
  template <class Add>
  TORYU_INLINE void over_pairs(std::size_t cluster, Add&& add) const {
    const double* w = weight_.data() + start_[cluster];
    over_sources(list_.sources(cluster), load(X_, cluster * lane_count), pointers(X_),
                 [&](std::uint32_t j, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
                   const Lanes weight = load(w);  // once, before w moves: else each use reads it anew
                   w += lane_count;
                   add(j, weight, X_ij);
                 });
  }

  const VecField& X_;
  ClusterList list_;
  std::vector<std::size_t> start_;  ///< of a cluster's weights
  Field weight_;                    ///< V_j W'_ij/R_ij in lanes i, source by source [1/m2]; 0 for i = j
  Tensor<Field> L_;
};

template <class Central>
VecLanes ReferencePairs::central_force_density(const VecField& u, const VecField& v, std::size_t cluster,
                                               Central&& g) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes u_i = load(u, i), v_i = load(v, i), X_i = load(X_, i);
  const VecLanes x_i{X_i[0] + u_i[0], X_i[1] + u_i[1]};
  const Positions X_of = pointers(X_), u_of = pointers(u), v_of = pointers(v);
  VecLanes f = zero_vector();
  over_pairs(cluster, [&](std::uint32_t j, const Lanes& weight, const VecLanes&) TORYU_INLINE_LAMBDA {
    const VecLanes x_ij{x_i[0] - (X_of[0][j] + u_of[0][j]), x_i[1] - (X_of[1][j] + u_of[1][j])};
    add_product(f, weight * g(dot(difference(v_i, v_of, j), x_ij), dot(x_ij, x_ij)), x_ij);
  });
  return f;
}

}  // namespace toryu::solid
