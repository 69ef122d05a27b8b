#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solid_solver/terms/artificial_stress.hpp"
#include "solid_solver/terms/artificial_viscosity.hpp"
#include "solid_solver/terms/hookes_law.hpp"
#include "solid_solver/terms/hourglass_penalty.hpp"

namespace toryu::solid {
namespace {

TEST(ArtificialViscosity, PushesOnlyPairsThatApproach) {
  const PairViscosity Pi{.alpha_c = 3.0, .beta = 2.0, .h = 0.5, .inverse_rho = 1e-3};
  // r = 0.4 and v.x = -0.08 by hand: theta = -0.5 * 0.08/(0.16 + 0.0025) = -0.24615...
  const double theta = -0.5 * 0.08 / 0.1625;
  EXPECT_NEAR(Pi(-0.08, 0.16)[0], (-3.0 * theta + 2.0 * theta * theta) * 1e-3, 1e-15);
  EXPECT_GT(Pi(-0.08, 0.16)[0], 0.0);
  EXPECT_EQ(Pi(0.08, 0.16)[0], 0.0);
}

TEST(ArtificialStress, OpposesTensilePrincipalStresses) {
  // Principal stresses 5 and -1 at 30 degrees: only the first counts.
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  const Symmetric<Lanes> sigma{5 * c * c - s * s, 5 * s * s - c * c, 6 * c * s};
  const auto R = artificial_stress(sigma, 1.0 / 4.0, 0.3);
  EXPECT_NEAR(R.xx[0], -0.3 * 5 / 4 * c * c, 1e-14);
  EXPECT_NEAR(R.yy[0], -0.3 * 5 / 4 * s * s, 1e-14);
  EXPECT_NEAR(R.xy[0], -0.3 * 5 / 4 * c * s, 1e-14);
}

TEST(ArtificialStress, HandlesEqualPrincipalStresses) {
  const auto R = artificial_stress({2.0, 2.0, 0.0}, 1.0, 0.3);
  EXPECT_NEAR(R.xx[0], -0.6, 1e-15);
  EXPECT_NEAR(R.yy[0], -0.6, 1e-15);
  EXPECT_EQ(R.xy[0], 0.0);
  const auto compressed = artificial_stress({-2.0, -1.0, 0.5}, 1.0, 0.3);
  EXPECT_EQ(compressed.xx[0], 0.0);
  EXPECT_EQ(compressed.yy[0], 0.0);
}

TEST(HourglassPenalty, StiffnessFollowsPoissonsRatioAsBendingDoes) {
  const HourglassPenalty penalty{.coefficient = 2.0};
  EXPECT_DOUBLE_EQ(penalty.stiffness({1000, 3e6, 0.0}), 6e6) << "alpha E";
  // nu = 1/3: n = 1/2, E/(1 - nu^2) = 9/8 E, 7 + 1 + 3/4 = 35/4
  EXPECT_NEAR(penalty.stiffness({1000, 3e6, 1.0 / 3.0}) / (6e6 * 9 / 8 * 7 * 4 / 35), 1.0, 1e-14);
}

class HookesLawTest : public testing::Test {
 protected:
  const double E = 2e6, nu = 0.4, K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
  const HookesLaw law{K, G, 1000.0};

  /// Stress after the small strain of grad_v over one unit of time.
  Symmetric<double> stress(const Tensor<double>& grad_v) const {
    const auto s = law.rate<double>({0, 0, 0}, grad_v);
    const double p = law.pressure(1000.0 * (1 - grad_v[0] - grad_v[3]));
    return {s.xx - p, s.yy - p, s.xy};
  }
};

TEST_F(HookesLawTest, PassesThePatchTests) {
  const double eps = 1e-6;
  const auto uniaxial = stress({eps, 0, 0, -nu / (1 - nu) * eps});
  EXPECT_NEAR(uniaxial.xx / (E / (1 - nu * nu) * eps), 1.0, 1e-9);
  EXPECT_NEAR(uniaxial.yy / (E * eps), 0.0, 1e-9);
  EXPECT_NEAR(stress({eps, 0, 0, eps}).xx / ((2 * K + 2 * G / 3) * eps), 1.0, 1e-9);
  EXPECT_NEAR(stress({0, eps, 0, 0}).xy / (G * eps), 1.0, 1e-12);
}

/// Stress after `steps` midpoint steps of a constant velocity gradient over a time of 1.
Symmetric<double> after(const HookesLaw& law, Symmetric<double> s, const Tensor<double>& grad_v, int steps) {
  const double dt = 1.0 / steps;
  const auto moved = [&](const Symmetric<double>& rate, double time) {
    return Symmetric<double>{s.xx + time * rate.xx, s.yy + time * rate.yy, s.xy + time * rate.xy};
  };
  for (int n = 0; n < steps; ++n) s = moved(law.rate(moved(law.rate(s, grad_v), dt / 2), grad_v), dt);
  return s;
}

TEST_F(HookesLawTest, StressTurnsWithTheBodyAndTheErrorFallsWithTheSquareOfTheStep) {
  const double w = 2 * std::numbers::pi;  // a turn
  const Tensor<double> rotation{0, -w, w, 0};
  const auto error = [&](int steps) {
    const auto s = after(law, {3e3, -1e3, 2e3}, rotation, steps);
    return std::hypot(s.xx - 3e3, s.yy + 1e3, s.xy - 2e3);
  };
  EXPECT_LT(error(800), 2.0) << "of 3742 Pa";
  EXPECT_NEAR(error(400) / error(800), 4.0, 0.2);
  const auto quarter = after(law, {3e3, -1e3, 2e3}, {0, -w / 4, w / 4, 0}, 2000);
  EXPECT_NEAR(quarter.xx, -1e3, 0.1);
  EXPECT_NEAR(quarter.yy, 3e3, 0.1);
  EXPECT_NEAR(quarter.xy, -2e3, 0.1);
}

TEST_F(HookesLawTest, LargeShearOscillatesUnderTheJaumannRate) {
  for (double gamma : {0.5, 2.0, 4.0})
    EXPECT_NEAR(after(law, {0, 0, 0}, {0, gamma, 0, 0}, 4000).xy / (G * std::sin(gamma)), 1.0, 1e-3) << gamma;
}

}  // namespace
}  // namespace toryu::solid
