/// The kernels, in two dimensions, of support 2h. Positive parts make each one expression, so that lanes need
/// no masks: beyond 2h it is zero by itself.
#pragma once

#include <numbers>
#include <variant>

#include "common/sph/lanes.hpp"
#include "common/vector.hpp"

namespace toryu {

static_assert(dim == 2, "the kernels are normalised for two dimensions");

/// Monaghan & Lattanzio (1985); thesis eq. 10-11:
///
///     W(s) = alpha/h^2 [ (2 - s)_+^3 - 4 (1 - s)_+^3 ] / 4,   s = r/h,   alpha = 10/(7 pi)
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
    return positive(less_product(T(2.0), r, T(inverse_h_)));
  }
  template <class T>
  TORYU_INLINE T inner(T r) const {
    return positive(less_product(T(1.0), r, T(inverse_h_)));
  }

  double h_, inverse_h_, value_factor_, gradient_factor_;
};

/// The C2 function of Wendland (1995), here with the support of the cubic spline (Dehnen & Aly 2012):
///
///     W(s) = 7/(4 pi h^2) (1 - s/2)_+^4 (1 + 2 s),   s = r/h
///
/// Its Fourier transform is positive, so that particles do not pair however many neighbours they have.
class WendlandC2 {
 public:
  /// `h` [m] is half of the support.
  explicit WendlandC2(double h)
      : h_(h),
        inverse_h_(1.0 / h),
        value_factor_(7.0 / (4.0 * std::numbers::pi * h * h)),
        gradient_factor_(-5.0 * value_factor_ / (h * h)) {}

  double h() const { return h_; }
  double support() const { return 2.0 * h_; }

  /// W [1/m2] at distance r [m].
  template <class T>
  TORYU_INLINE T value(T r) const {
    const T q = inner_part(r), q_2 = q * q;
    return value_factor_ * (q_2 * q_2) * (1.0 + 2.0 * inverse_h_ * r);
  }
  /// dW/dr / r [1/m4], given r: without the division by r that other kernels need.
  template <class T>
  TORYU_INLINE T gradient_over_r(T r, T) const {
    const T q = inner_part(r);
    return gradient_factor_ * (q * q * q);
  }

 private:
  TORYU_INLINE static double positive(double a) { return a > 0.0 ? a : 0.0; }
  TORYU_INLINE static Lanes positive(Lanes a) { return positive_part(a); }
  /// (1 - s/2)_+
  template <class T>
  TORYU_INLINE T inner_part(T r) const {
    return positive(less_product(T(1.0), r, T(0.5 * inverse_h_)));
  }

  double h_, inverse_h_, value_factor_, gradient_factor_;
};

/// The kernel that a case has asked for. What loops over pairs takes it apart once, outside the loop, by
/// `visit`.
class Kernel {
 public:
  Kernel(const CubicSpline& form) : form_(form) {}
  Kernel(const WendlandC2& form) : form_(form) {}

  template <class Visit>
  decltype(auto) visit(Visit&& visit) const {
    return std::visit(visit, form_);
  }
  double h() const {
    return visit([](const auto& W) { return W.h(); });
  }
  double support() const {
    return visit([](const auto& W) { return W.support(); });
  }
  /// W [1/m2] at distance r [m].
  double value(double r) const {
    return visit([&](const auto& W) { return W.value(r); });
  }

 private:
  std::variant<CubicSpline, WendlandC2> form_;
};

}  // namespace toryu
