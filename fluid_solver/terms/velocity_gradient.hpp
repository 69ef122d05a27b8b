/// Renormalised velocity gradient of particles i,
///
///     <grad v>_i = L_i sum_j V_j gradW_ij (x) (v_j - v_i)
///
/// over fluid particles and, where there is no slip, walls with their v_w-f (28), so that the shear at a wall
/// is seen. Exact in a linear velocity. A particle without enough neighbours (L_i near singular) has none.
#pragma once

#include "common/sph/neighbour_loop.hpp"
#include "common/sph/renormalisation.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

class VelocityGradient {
 public:
  VelocityGradient(const VecLanes& x_i, const VecLanes& v_i) : x_i_(x_i), v_i_(v_i) {}

  template <class W>
  TORYU_INLINE void add(const Sources& source, std::span<const ShiftedNeighbours> neighbours,
                        const W& kernel) {
    over_neighbours(kernel, neighbours, x_i_, source.x,
                    [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                      const VecLanes V_grad = n.gradient(source.V[j]);
                      moment_.add(n.x_ij, V_grad);
                      for (int b = 0; b < dim; ++b)
                        add_product(sums_[b], source.v_viscous[b][j] - v_i_[b], V_grad);
                    });
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
