/// Renormalised velocity gradient of particles i,
///
///     <grad v>_i = L_i sum_j V_j gradW_ij (x) (v_j - v_i)
///
/// over fluid particles and, where there is no slip, walls with their v_w-f (28), so that the shear at a wall
/// is seen. Exact in a linear velocity. A particle without enough neighbours (L_i near singular) has none.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "fluid_solver/terms/renormalisation.hpp"

namespace toryu::fluid {

class VelocityGradient {
 public:
  VelocityGradient(const VecLanes& x_i, const VecLanes& v_i) : x_i_(x_i), v_i_(v_i) {}

  template <class W>
  TORYU_INLINE void add(const Sources& source, std::span<const Near> neighbours, const W& kernel) {
    for (const Near& near : neighbours) add(source, near, kernel);
  }

  /// [a][b]: dv_b/dx_a [1/s].
  TORYU_INLINE TensorLanes value() {
    moment_.invert();
    TensorLanes grad_v;
    for (int b = 0; b < dim; ++b) {
      const VecLanes grad_v_b = moment_.renormalised(sums_[b]);
      for (int a = 0; a < dim; ++a) grad_v[a][b] = grad_v_b[a];
    }
    return grad_v;
  }

 private:
  template <class W>
  TORYU_INLINE void add(const Sources& source, const Near& near, const W& kernel) {
    const VecLanes x_i = shifted(x_i_, near.shift);
    for (const std::uint32_t j : near.sources) {
      const VecLanes x_ij{x_i[0] - source.x[0][j], x_i[1] - source.x[1][j]};
      const Lanes r2 = max(dot(x_ij, x_ij), 1e-300);
      const Lanes inverse_r = inverse_sqrt(r2);
      const Lanes V_G = source.V[j] * kernel.gradient_over_r(r2 * inverse_r, inverse_r);
      const VecLanes V_grad{V_G * x_ij[0], V_G * x_ij[1]};
      moment_.add(x_ij, V_grad);
      for (int b = 0; b < dim; ++b) {
        const Lanes v_ji = source.v_viscous[b][j] - v_i_[b];
        for (int a = 0; a < dim; ++a) sums_[b][a] += v_ji * V_grad[a];
      }
    }
  }

  VecLanes x_i_, v_i_;
  Moment moment_;
  TensorLanes sums_ = zero_tensor();  ///< one row a component of the velocity
};

/// gdot = sqrt(2 D : D) [1/s], D = (grad v + grad v^T)/2.
TORYU_INLINE Lanes shear_rate(const TensorLanes& grad_v) {
  Lanes D_D = 0.0;
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b) {
      const Lanes D_ab = 0.5 * (grad_v[a][b] + grad_v[b][a]);
      D_D += D_ab * D_ab;
    }
  return square_root(2.0 * D_D);
}

}  // namespace toryu::fluid
