/// Renormalisation of gradients (21) (Randles & Libersky 1996): the moment of a particle's neighbours,
///
///     L_i^-1 = sum_j V_j (x_j - x_i) (x) gradW_ij,
///
/// by whose inverse a gradient of a linear field comes out exact, however the neighbours lie.
#pragma once

#include "common/sph/points.hpp"
#include "common/sph/tensor.hpp"

namespace toryu {

/// Smallest eigenvalue of L^-1 (1 in a full lattice, about 1/2 at a straight free surface) that is inverted.
inline constexpr double smallest_moment = 0.1;

class Moment {
 public:
  /// Adds a neighbour; `V_grad` is V_j gradW_ij.
  TORYU_INLINE void add(const VecLanes& x_ij, const VecLanes& V_grad) {
    static_assert(dim == 2, "the inverse below is written for two dimensions");
    xx_ -= x_ij[0] * V_grad[0];
    xy_ -= x_ij[0] * V_grad[1];
    yy_ -= x_ij[1] * V_grad[1];
  }
  TORYU_INLINE Lanes determinant() const { return xx_ * yy_ - xy_ * xy_; }
  /// L_i times the determinant.
  TORYU_INLINE Tensor<Lanes> adjugate() const { return {yy_, -xy_, -xy_, xx_}; }
  TORYU_INLINE Lanes trace() const { return xx_ + yy_; }
  TORYU_INLINE Lanes smaller_eigenvalue() const {
    const Lanes half_trace = 0.5 * (xx_ + yy_), half_difference = 0.5 * (xx_ - yy_);
    return half_trace - square_root(half_difference * half_difference + xy_ * xy_);
  }
  /// Prepares `renormalised` when all neighbours are in.
  TORYU_INLINE void invert() {
    const Lanes det = determinant(), trace = xx_ + yy_;
    // the smaller eigenvalue exceeds m where both do: det - m trace + m^2 > 0 and trace > 2 m
    const auto regular = (det - smallest_moment * trace + smallest_moment * smallest_moment > 0.0) &
                         (trace > 2.0 * smallest_moment);
    share_ = select(regular, inverse(max(det, 1e-12)), 0.0);
  }
  /// L_i b; zero where L_i is near singular (few neighbours, one-sided).
  TORYU_INLINE VecLanes renormalised(const VecLanes& b) const {
    return {share_ * (yy_ * b[0] - xy_ * b[1]), share_ * (xx_ * b[1] - xy_ * b[0])};
  }

 private:
  Lanes xx_ = 0.0, xy_ = 0.0, yy_ = 0.0, share_ = 0.0;
};

}  // namespace toryu
