/// The cubic spline kernel in two dimensions (Monaghan & Lattanzio 1985; thesis eq. 10-11), support 2h:
///
///     W(s) = alpha/h^2 [ (2 - s)_+^3 - 4 (1 - s)_+^3 ] / 4,   s = r/h,   alpha = 10/(7 pi)
///
/// The positive parts make it one expression, so that lanes need no masks: beyond 2h it is zero by itself.
#pragma once

#include <numbers>

#include "common/sph/lanes.hpp"

namespace toryu {

class CubicSpline {
 public:
  /// `h` [m] is the smoothing length.
  explicit CubicSpline(double h)
      : h_(h),
        inverse_h_(1.0 / h),
        value_factor_(10.0 / (7.0 * std::numbers::pi) / (4.0 * h * h)),
        gradient_factor_(-3.0 * value_factor_ / h) {}

  double h() const { return h_; }
  double support() const { return 2.0 * h_; }

  /// W [1/m2] at distance r [m].
  template <class T>
  TORYU_INLINE T value(T r) const {
    const T q_2 = outer(r), q_1 = inner(r);
    return value_factor_ * (q_2 * q_2 * q_2 - 4.0 * (q_1 * q_1 * q_1));
  }
  /// dW/dr / r [1/m4], given r and 1/r: gradW_ij = x_ij times this.
  template <class T>
  TORYU_INLINE T gradient_over_r(T r, T inverse_r) const {
    const T q_2 = outer(r), q_1 = inner(r);
    return gradient_factor_ * (q_2 * q_2 - 4.0 * (q_1 * q_1)) * inverse_r;
  }

 private:
  TORYU_INLINE static double positive(double a) { return a > 0.0 ? a : 0.0; }
  TORYU_INLINE static Lanes positive(Lanes a) { return positive_part(a); }
  template <class T>
  TORYU_INLINE T outer(T r) const {
    return positive(2.0 - r * inverse_h_);
  }
  template <class T>
  TORYU_INLINE T inner(T r) const {
    return positive(1.0 - r * inverse_h_);
  }

  double h_, inverse_h_, value_factor_, gradient_factor_;
};

}  // namespace toryu
