/// Hooke's law of the updated Lagrangian form (Gray, Monaghan & Swift 2001; thesis eq. 5-8), in plane strain:
///
///     p = K (rho/rho_0 - 1),   sigma = -p I + s
///     Ds/Dt = 2 G (e' - tr(e')/3 I) + s omega^T + omega s
///     e' = (grad v + grad v^T)/2,   omega_ab = (dv_a/dx_b - dv_b/dx_a)/2
///
/// s_zz = -(s_xx + s_yy) is not stored. In large shear s_xy = G sin(gamma): the law's property.
#pragma once

#include "common/sph/tensor.hpp"
#include "common/vector.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the law is that of plane strain");

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
  /// s [Pa] after a time dt [s] of constant grad v [1/s]: half the turn, the strain, the other half. The turn
  /// keeps the size of s exactly (Hughes & Winget 1980): (s_xx - s_yy)/2 and s_xy turn as a vector, each half
  /// by 2 atan(omega dt/2).
  template <class T>
  Symmetric<T> after(const Symmetric<T>& s, const Tensor<T>& grad_v, double dt) const {
    const T third = (grad_v[0] + grad_v[3]) * (1.0 / 3.0);
    const T t = 0.25 * dt * (grad_v[1] - grad_v[2]);
    const T scale = 1.0 / (1.0 + t * t), cosine = (1.0 - t * t) * scale, sine = 2.0 * t * scale;
    const auto turned = [&](const Symmetric<T>& a) -> Symmetric<T> {
      const T mean = 0.5 * (a.xx + a.yy), difference = 0.5 * (a.xx - a.yy);
      const T D = cosine * difference + sine * a.xy;
      return {mean + D, mean - D, cosine * a.xy - sine * difference};
    };
    const Symmetric<T> half = turned(s);
    return turned({half.xx + 2.0 * G * dt * (grad_v[0] - third), half.yy + 2.0 * G * dt * (grad_v[3] - third),
                   half.xy + G * dt * (grad_v[1] + grad_v[2])});
  }
  /// Energy per volume [J/m3] of p and s.
  double energy(double rho, const Symmetric<double>& s) const {
    const double p = pressure(rho), zz = -(s.xx + s.yy);
    return p * p / (2.0 * K) + (s.xx * s.xx + s.yy * s.yy + zz * zz + 2.0 * s.xy * s.xy) / (4.0 * G);
  }
};

}  // namespace toryu::solid
