// Both ways in which the updated Lagrangian form takes its steps.
#include <gtest/gtest.h>

#include <cmath>

#include "common/sph/kernel.hpp"
#include "samples.hpp"

namespace toryu::solid {
namespace {

/// Two particles side by side, part from each other with a small velocity. Along x it is an oscillator: with
/// e_xx = V |W'| w, w the velocity of parting, sigma_xx grows by rho c_L^2 e_xx, and dw/dt = -4 m |W'|
/// sigma_xx/rho^2, so omega = 2 c_L V |W'|.
struct Oscillator {
  Parameters p;
  double omega;
  explicit Oscillator(Integrator integrator) {
    const double d = 0.005;
    p = free_plate(4);
    p.formulation = Formulation::updated_lagrangian;
    p.integrator = integrator;
    p.hourglass.reset();
    const auto moving = [](double v) { return InitialVelocity{.velocity = Vec(v, 0)}; };
    p.regions = {{.name = "left", .box = {Vec(0, 0), Vec(d, d)}, .initial_velocity = moving(-1e-6)},
                 {.name = "right", .box = {Vec(d, 0), Vec(2 * d, d)}, .initial_velocity = moving(1e-6)}};
    const double slope = CubicSpline(p.h()).gradient_over_r(d, 1 / d) * d;
    omega = 2 * p.material.longitudinal_sound_speed() * d * d * std::abs(slope);
  }
  static double energy(const SolidModel& model) {
    return observed(model, "kinetic_energy") + observed(model, "elastic_energy");
  }
  /// Energy over the first after so many steps of turn omega dt.
  double growth(double turn, int steps) const {
    const auto model = model_of(p);
    const double start = energy(*model);
    double largest = 0;
    for (int n = 0; n < steps; ++n) {
      model->advance(turn / omega);
      largest = std::max(largest, energy(*model));
    }
    return (p.integrator == Integrator::midpoint ? energy(*model) : largest) / start;
  }
};

TEST(Midpoint, AmplifiesAnUndampedModeByTheFourthPowerOfItsTurn) {
  const Oscillator oscillator(Integrator::midpoint);
  for (const double turn : {0.3, 0.5, 1.0})
    EXPECT_NEAR(oscillator.growth(turn, 20) / std::pow(1 + std::pow(turn, 4) / 4, 20), 1, 1e-4) << turn;
}

TEST(Symplectic, KeepsTheEnergyOfAnUndampedModeUpToATurnOfTwo) {
  // Of the staggered pair the scheme keeps w^2 + (1 - (omega dt/2)^2) sigma^2, so the sum swings by that
  // much.
  const Oscillator oscillator(Integrator::symplectic);
  EXPECT_LT(oscillator.growth(0.3, 2000), 1 / (1 - 0.25 * 0.09) + 1e-3);
  EXPECT_LT(oscillator.growth(1.9, 2000), 1 / (1 - 0.25 * 3.61) * 1.01);
  EXPECT_GT(oscillator.growth(2.1, 100), 1e6);
}

TEST(Symplectic, TurnsByTheAngleOfTheLeapfrog) {
  const Oscillator oscillator(Integrator::symplectic);
  const auto model = model_of(oscillator.p);
  const double turn = 0.8, angle = 2 * std::asin(turn / 2);
  const Vec first = model->velocity(1);
  for (int n = 1; n <= 50; ++n) {
    model->advance(turn / oscillator.omega);
    ASSERT_NEAR(model->velocity(1)[0], first[0] * std::cos(n * angle), 1e-3 * first[0]);
  }
}

class Order : public testing::TestWithParam<std::tuple<Integrator, Gradients>> {};
INSTANTIATE_TEST_SUITE_P(Both, Order,
                         testing::Combine(testing::Values(Integrator::midpoint, Integrator::symplectic),
                                          testing::Values(Gradients::plain, Gradients::renormalised)),
                         [](const auto& form) {
                           return std::string(std::get<0>(form.param) == Integrator::midpoint
                                                  ? "midpoint"
                                                  : "symplectic") +
                                  (std::get<1>(form.param) == Gradients::plain ? "_plain" : "_renormalised");
                         });

/// A plate that bends, stretches and turns: where its particles are after 0.4 ms in so many steps.
std::vector<Vec> end_of(std::tuple<Integrator, Gradients> form, int steps) {
  Parameters p = free_plate(4);
  p.formulation = Formulation::updated_lagrangian;
  p.integrator = std::get<0>(form);
  p.gradients = std::get<1>(form);
  p.hourglass.reset();
  p.initial_velocity = InitialVelocity{.profile = VelocityProfile::linear,
                                       .origin = Vec(0.04, 0.01),
                                       .gradient = {{200.0, -100.0}, {300.0, -50.0}}};
  const auto model = model_of(p);
  for (int n = 0; n < steps; ++n) model->advance(4e-4 / steps);
  std::vector<Vec> x;
  for (std::size_t i = 0; i < model->particle_count(); ++i) x.push_back(model->displacement(i));
  return x;
}

TEST_P(Order, ErrorFallsWithTheSquareOfTheStep) {
  const auto exact = end_of(GetParam(), 1280);
  const auto error = [&](int steps) {
    const auto x = end_of(GetParam(), steps);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - exact[i]).squaredNorm();
    return std::sqrt(sum);
  };
  const double coarse = error(40), fine = error(160);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2.0, 0.15);
  EXPECT_LT(fine, 1e-2 * exact.front().norm());
}

}  // namespace
}  // namespace toryu::solid
