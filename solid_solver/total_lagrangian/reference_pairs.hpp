/// The pairs of the unloaded body, found once: weights, shapes, and the two sums over pairs of which the
/// total Lagrangian form consists. Nothing here knows a material.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
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
  const VecLanes x_i{load(X_[0], i) + load(u[0], i), load(X_[1], i) + load(u[1], i)}, v_i = load(v, i);
  VecLanes f{0.0, 0.0};
  const double* w = weight_.data() + start_[cluster];
  for (const std::uint32_t j : list_.sources(cluster)) {
    const VecLanes x_ij{x_i[0] - (X_[0][j] + u[0][j]), x_i[1] - (X_[1][j] + u[1][j])};
    const VecLanes v_ij{v_i[0] - v[0][j], v_i[1] - v[1][j]};
    const Lanes factor = load(w) * g(dot(v_ij, x_ij), dot(x_ij, x_ij));
    f[0] += factor * x_ij[0];
    f[1] += factor * x_ij[1];
    w += lane_count;
  }
  return f;
}

}  // namespace toryu::solid
