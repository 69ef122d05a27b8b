#include "common/sph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace toryu {
namespace {

TEST(CubicSpline, HasTheValuesOfEquation11) {
  const double h = 0.5;
  const CubicSpline W(h);
  const double f_0 = 10.0 / (7.0 * std::numbers::pi);
  EXPECT_NEAR(W.value(0.0), f_0 / (h * h), 1e-14);
  EXPECT_NEAR(W.value(0.5 * h), f_0 * (1 - 1.5 * 0.25 + 0.75 * 0.125) / (h * h), 1e-14);
  EXPECT_NEAR(W.value(1.5 * h), 0.5 * f_0 * std::pow(0.5, 3) / 2 / (h * h), 1e-14);
  EXPECT_EQ(W.value(2.0 * h), 0.0);
  EXPECT_EQ(W.value(2.5 * h), 0.0);
}

TEST(WendlandC2, HasTheValuesOfItsFormula) {
  const double h = 0.5;
  const WendlandC2 W(h);
  const double f_0 = 7.0 / (4.0 * std::numbers::pi);
  EXPECT_NEAR(W.value(0.0), f_0 / (h * h), 1e-14);
  EXPECT_NEAR(W.value(h), f_0 * 3.0 / 16.0 / (h * h), 1e-14);                       // (1/2)^4 (1 + 2)
  EXPECT_NEAR(W.value(1.5 * h), f_0 * 4.0 / 256.0 / (h * h), 1e-14);                // (1/4)^4 (1 + 3)
  EXPECT_NEAR(W.gradient_over_r(h, 1 / h) * h, -5 * f_0 / 8 / (h * h * h), 1e-13);  // -5 s (1/2)^3
  EXPECT_EQ(W.value(2.0 * h), 0.0);
  EXPECT_EQ(W.value(2.5 * h), 0.0);
}

template <class W>
class AnyKernel : public testing::Test {};
using Kernels = testing::Types<CubicSpline, WendlandC2>;
TYPED_TEST_SUITE(AnyKernel, Kernels);

TYPED_TEST(AnyKernel, IntegratesToOne) {
  const TypeParam W(0.013);
  double integral = 0;
  const int n = 2000;
  for (int k = 0; k < n; ++k) {
    const double r = (k + 0.5) * W.support() / n;
    integral += W.value(r) * 2 * std::numbers::pi * r * W.support() / n;
  }
  EXPECT_NEAR(integral, 1.0, 1e-6);
}

TYPED_TEST(AnyKernel, HasTheSlopeOfItsValueAsGradient) {
  const TypeParam W(0.7);
  for (double r : {0.1, 0.4, 0.69, 0.71, 1.0, 1.39}) {
    const double d = 1e-6;
    const double slope = (W.value(r + d) - W.value(r - d)) / (2 * d);
    EXPECT_NEAR(W.gradient_over_r(r, 1 / r) * r, slope, 1e-7) << "r = " << r;
  }
  EXPECT_EQ(W.gradient_over_r(1.41, 1 / 1.41), 0.0);
}

TYPED_TEST(AnyKernel, IsTheSameAsTheChosenOne) {
  const TypeParam W(0.7);
  const Kernel chosen(W);
  EXPECT_EQ(chosen.h(), 0.7);
  EXPECT_EQ(chosen.support(), 1.4);
  EXPECT_EQ(chosen.value(0.5), W.value(0.5));
}

TEST(Lanes, InverseAndInverseSquareRootHoldFullPrecision) {
  for (double a : {1e-12, 3e-7, 0.3, 1.0, 2.0, 7.7e5, 1e12}) {
    EXPECT_NEAR(inverse(Lanes(a))[0] * a, 1.0, 5e-16) << a;
    EXPECT_NEAR(inverse_sqrt(Lanes(a))[0] * std::sqrt(a), 1.0, 7e-16) << a;
  }
}

}  // namespace
}  // namespace toryu
