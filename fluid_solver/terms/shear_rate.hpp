/// Shear rate gdot = sqrt(2 D : D) [1/s], D = (grad v + grad v^T)/2, from the renormalised velocity gradient
///
///     <grad v>_i = L_i sum_j V_j gradW_ij (x) (v_j - v_i)
///
/// over fluid particles and, where there is no slip, walls with their v_w-f (28), so that the shear at a wall
/// is seen. A particle without enough neighbours (L_i near singular) has the shear rate zero.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "fluid_solver/terms/renormalisation.hpp"

namespace toryu::fluid {

class ShearRate {
 public:
  ShearRate(const VecLanes& x_i, const VecLanes& v_i) : x_i_(x_i), v_i_(v_i) {}

  TORYU_INLINE void add(const Sources& source, std::span<const std::uint32_t> neighbours,
                        const CubicSpline& kernel) {
    for (const std::uint32_t j : neighbours) {
      const VecLanes x_ij{x_i_[0] - source.x[0][j], x_i_[1] - source.x[1][j]};
      const Lanes r2 = max(dot(x_ij, x_ij), 1e-300);
      const Lanes inverse_r = inverse_sqrt(r2);
      const Lanes V_G = source.V[j] * kernel.gradient_over_r(r2 * inverse_r, inverse_r);
      const VecLanes V_grad{V_G * x_ij[0], V_G * x_ij[1]};
      moment_.add(x_ij, V_grad);
      for (int a = 0; a < dim; ++a) {
        const Lanes v_ji = source.v_viscous[a][j] - v_i_[a];
        for (int b = 0; b < dim; ++b) sums_[a][b] += v_ji * V_grad[b];
      }
    }
  }

  TORYU_INLINE Lanes value() {
    moment_.invert();
    const VecLanes grad_u = moment_.renormalised(sums_[0]), grad_v = moment_.renormalised(sums_[1]);
    const Lanes D_xx = grad_u[0], D_yy = grad_v[1], D_xy = 0.5 * (grad_u[1] + grad_v[0]);
    return square_root(2.0 * (D_xx * D_xx + D_yy * D_yy + 2.0 * D_xy * D_xy));
  }

 private:
  VecLanes x_i_, v_i_;
  Moment moment_;
  std::array<VecLanes, dim> sums_{zero_vector(), zero_vector()};  ///< of each component of the velocity
};

}  // namespace toryu::fluid
