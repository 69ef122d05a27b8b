/// The pairs of the unloaded body, found once: weights, shapes, and the two sums over pairs of which the
/// total Lagrangian form consists. Nothing here knows a material.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/neighbour_loop.hpp"
#include "common/sph/points.hpp"
#include "common/sph/renormalisation.hpp"
#include "common/sph/tensor.hpp"
#include "solid_solver/shape.hpp"
#include "solid_solver/total_lagrangian/clamp_faces.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the sums and the inverse have the components of the plane");

class ReferencePairs {
 public:
  /// X [m] in strip order of strips `strip_width` [m] wide, volume [m2]; both padded to whole lanes, as is
  /// what is `held`: clamp_faces.hpp says how that changes X_ij and gradW_ij of its pairs. Pairs between
  /// which `shape` has no material have no weight. A body that repeats itself by `shifts` (Period) has pairs
  /// across the period, whose displacements are those of the particles themselves.
  ReferencePairs(const VecField& X, const Field& volume, std::size_t count, double h, double strip_width,
                 const std::optional<Held>& held = std::nullopt, const Shape& shape = {},
                 const std::vector<Vec>& shifts = {Vec::Zero()});

  /// Displacement gradient, renormalised, so that it is exact for linear u (Randles & Libersky 1996):
  ///
  ///     H_i = sum_j V_j (u_j - u_i) (x) L_i gradW_ij,   L_i = [sum_j V_j (X_j - X_i) (x) gradW_ij]^-1
  void displacement_gradient(const VecField& u, std::size_t cluster, Tensor<Lanes>& H) const;

  /// f_i/V_i = sum_j V_j [(T_i + T_j) gradW_ij + k (u_i - u_j) W'_ij/R_ij]: equal and opposite for a pair.
  /// T [Pa] is any tensor of a particle, k [Pa] the stiffness of the pair penalty.
  VecLanes force_density(const VecField& u, const Tensor<Field>& T, double k, std::size_t cluster) const;
  /// The same with (k_i + k_j)/2 for k.
  VecLanes force_density(const VecField& u, const Tensor<Field>& T, const Field& k,
                         std::size_t cluster) const;

  /// sum_j V_j g(j, v_ij.x_ij, r_ij^2) x_ij W'_ij/R_ij: central forces between present positions, for
  /// viscosity.
  template <class Central>
  VecLanes central_force_density(const VecField& u, const VecField& v, std::size_t cluster,
                                 Central&& g) const;

  /// sum_j V_j |u_ij - H_i X_ij|^2 (-W'_ij/R_ij) [1]: what H_i does not see.
  Lanes unseen_motion(const VecField& u, const Tensor<Lanes>& H, std::size_t cluster) const;

  Tensor<Lanes> shape(std::size_t cluster) const;  ///< L

  const ClusterList& neighbours() const { return list_; }
  /// Calls use(j, V_j W'_ij/R_ij, X_ij) for what is near the particle in slot i.
  template <class Use>
  void over_neighbours(std::size_t i, Use&& use) const {
    const std::size_t lane = i % lane_count;
    over_pairs(i / lane_count, [&](std::uint32_t j, const Lanes& weight, const VecLanes& X_ij) {
      if (weight[lane] != 0) use(j, weight[lane], Vec(X_ij[0][lane], X_ij[1][lane]));
    });
  }

 private:
  /// Calls add(j, V_j W'_ij/R_ij, X_ij) for the sources of a cluster.
  template <class Add>
  TORYU_INLINE void over_pairs(std::size_t cluster, Add&& add) const {
    const double* w = weight_.data() + start_[cluster];
    const auto next = [](const double*& value) TORYU_INLINE_LAMBDA {
      const Lanes lanes = load(value);  // once, before it moves: else each use reads it anew
      value += lane_count;
      return lanes;
    };
    const VecLanes X_i = load(X_, cluster * lane_count);
    const bool shared = share_start_[cluster] != none;
    const double* s = shared ? share_.data() + share_start_[cluster] : nullptr;
    for (const ShiftedNeighbours& near : list_.near(cluster))
      over_sources(near.sources, shifted(X_i, near.shift), pointers(X_),
                   [&](std::uint32_t j, const VecLanes& X_ij)
                       TORYU_INLINE_LAMBDA { add(j, next(w), shared ? product(next(s), X_ij) : X_ij); });
  }
  template <class Stiffness>
  VecLanes force_density_of(const VecField& u, const Tensor<Field>& T, std::size_t cluster,
                            const Stiffness& stiffness) const;
  /// Puts the shares of X_ij into `share_` where a particle of the cluster, or a source, is held.
  void find_shares(const ClampFaces& faces, std::size_t cluster, std::size_t count);
  /// V_j W'_ij/R_ij, and the moment of the pairs.
  Moment find_weights(const Field& volume, const CubicSpline& W, const Shape& shape, std::size_t cluster);

  const VecField& X_;
  ClusterList list_;
  static constexpr std::size_t none = -1;
  std::vector<std::size_t> start_;        ///< of a cluster's weights
  std::vector<std::size_t> share_start_;  ///< of its shares; none where nothing is held
  Field share_;                           ///< of X_ij, likewise [1]
  Field weight_;                          ///< V_j W'_ij/R_ij in lanes i, source by source [1/m2]; 0 for i = j
  Tensor<Field> L_;
};

template <class Central>
VecLanes ReferencePairs::central_force_density(const VecField& u, const VecField& v, std::size_t cluster,
                                               Central&& g) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes u_i = load(u, i), v_i = load(v, i);
  const Positions u_of = pointers(u), v_of = pointers(v);
  VecLanes f = zero_vector();
  over_pairs(cluster, [&](std::uint32_t j, const Lanes& weight, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
    const VecLanes u_ij = difference(u_i, u_of, j), x_ij{X_ij[0] + u_ij[0], X_ij[1] + u_ij[1]};
    add_product(f, weight * g(j, dot(difference(v_i, v_of, j), x_ij), dot(x_ij, x_ij)), x_ij);
  });
  return f;
}

}  // namespace toryu::solid
