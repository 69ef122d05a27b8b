/// Hooke's law of the updated Lagrangian form (Gray, Monaghan & Swift 2001; thesis eq. 5-8), in plane strain:
///
///     p = K (rho/rho_0 - 1),   sigma = -p I + s
///     Ds/Dt = 2 G (e' - tr(e')/3 I) + s omega^T + omega s
///     e' = (grad v + grad v^T)/2,   omega_ab = (dv_a/dx_b - dv_b/dx_a)/2
///
/// s_zz = -(s_xx + s_yy) is not stored. In large shear s_xy = G sin(gamma): the law's property.
#pragma once

#include "solid_solver/terms/tensor.hpp"

namespace toryu {

struct HookesLaw {
  double K, G, rho_0;

  template <class T>
  T pressure(const T& rho) const {
    return K * (rho * (1.0 / rho_0) - 1.0);
  }
  /// Ds/Dt [Pa/s] from s [Pa] and grad v [1/s].
  template <class T>
  Symmetric<T> rate(const Symmetric<T>& s, const Tensor<T>& grad_v) const {
    const T third = (grad_v[0] + grad_v[3]) * (1.0 / 3.0);
    const T omega = 0.5 * (grad_v[1] - grad_v[2]);
    return {2.0 * G * (grad_v[0] - third) + 2.0 * omega * s.xy,
            2.0 * G * (grad_v[3] - third) - 2.0 * omega * s.xy,
            G * (grad_v[1] + grad_v[2]) + omega * (s.yy - s.xx)};
  }
  /// Energy per volume [J/m3] of p and s.
  double energy(double rho, const Symmetric<double>& s) const {
    const double p = pressure(rho), zz = -(s.xx + s.yy);
    return p * p / (2.0 * K) + (s.xx * s.xx + s.yy * s.yy + zz * zz + 2.0 * s.xy * s.xy) / (4.0 * G);
  }
};

}  // namespace toryu
