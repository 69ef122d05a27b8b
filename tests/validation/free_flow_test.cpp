// Free surfaces that swing: cases/oscillating_drop, standing_wave, capillary_drop.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid_solver/initial_flow.hpp"
#include "fluid_solver/observers.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// Amplitude of the initial flow over time, at every step.
struct History {
  std::vector<double> time, amplitude;
};
History history(const FluidCase& the_case, double end) {
  WeaklyCompressible solver = the_case.solver();
  History seen;
  while (solver.time() < end) {
    solver.advance(solver.time_step_limit());
    seen.time.push_back(solver.time());
    seen.amplitude.push_back(flow_amplitude(solver.particles(), *the_case.parameters.initial_flow));
  }
  return seen;
}

/// Times at which the amplitude passes zero.
std::vector<double> zeros(const History& seen) {
  std::vector<double> found;
  for (std::size_t k = 1; k < seen.time.size(); ++k) {
    const double before = seen.amplitude[k - 1], after = seen.amplitude[k];
    if (before * after < 0)
      found.push_back(seen.time[k - 1] + (seen.time[k] - seen.time[k - 1]) * before / (before - after));
  }
  return found;
}

/// Period of the drop by the equations of Monaghan & Rafiee (2013), (33)-(35): dA/dt = (Omega^2 + A^2)(b^2 -
/// a^2)/(a^2 + b^2), da/dt = A a, db/dt = -A b; by the midpoint rule.
double exact_period(double A, double Omega) {
  double a = 1, b = 1, t = 0, previous = A, last = 0;
  const double dt = 1e-4;
  const auto rate = [&](double A_, double a_, double b_) {
    return (Omega * Omega + A_ * A_) * (b_ * b_ - a_ * a_) / (a_ * a_ + b_ * b_);
  };
  std::vector<double> falls;
  while (falls.size() < 2) {
    const double A_h = A + 0.5 * dt * rate(A, a, b), a_h = a + 0.5 * dt * A * a, b_h = b - 0.5 * dt * A * b;
    last = A;
    A += dt * rate(A_h, a_h, b_h);
    a += dt * A_h * a_h;
    b -= dt * A_h * b_h;
    t += dt;
    if (previous > 0 && A <= 0) falls.push_back(t - dt * A / (A - last));
    previous = A;
  }
  return falls[1] - falls[0];
}

TEST(OscillatingDrop, HasItsPeriod) {
  const double period = exact_period(1, 1);
  EXPECT_NEAR(period, 4.8273, 2e-4);
  const auto passes = zeros(history(FluidCase("oscillating_drop", {"fluid.spacing=0.1"}), 7.5));
  ASSERT_GE(passes.size(), 3u);
  const double found = passes[2] - passes[0];
  RecordProperty("period_over_exact", std::to_string(found / period));
  EXPECT_NEAR(found / period, 1.0, 0.02);
}

TEST(StandingWave, HasThePeriodOfAiry) {
  const double k = 2 * std::numbers::pi /* over 1 m */, omega = std::sqrt(9.81 * k * std::tanh(k * 0.5));
  const auto passes = zeros(history(FluidCase("standing_wave", {"fluid.spacing=0.05"}), 1.1));
  ASSERT_GE(passes.size(), 3u);
  const double found = omega * (passes[2] - passes[0]) / (2 * std::numbers::pi);
  RecordProperty("period_over_exact", std::to_string(found));
  EXPECT_NEAR(found, 1.0, 0.05);
}

TEST(CapillaryDrop, HasThePeriodOfRayleigh) {
  const double sigma = 0.072, rho = 1000, R = 1e-3;
  const double period = 2 * std::numbers::pi / std::sqrt(6 * sigma / (rho * R * R * R));
  const auto passes = zeros(history(FluidCase("capillary_drop", {"fluid.spacing=1e-4"}), 0.018));
  ASSERT_GE(passes.size(), 4u);
  const double found = 2 * (passes[3] - passes[0]) / 3;
  RecordProperty("period_over_exact", std::to_string(found / period));
  EXPECT_NEAR(found / period, 1.0, 0.03);
}

/// Mean pressure of the inner half of a resting drop, over sigma/(R - h/2): the tension sits h/2 deep.
TEST(CapillaryDrop, BearsThePressureOfLaplaceAtRest) {
  const double sigma = 0.072, R = 1e-3;
  const FluidCase the_case("capillary_drop/resting.toml", {"fluid.spacing=1e-4"});
  WeaklyCompressible solver = the_case.solver();
  run_until(solver, 4e-3);
  double sum = 0, count = 0;
  while (solver.time() < 8e-3) {
    solver.advance(solver.time_step_limit());
    const auto& f = solver.particles();
    for (std::size_t i = 0; i < f.count; ++i)
      if (at(f.x, i).norm() < 0.5 * R) sum += f.p[i], ++count;
  }
  const double found = sum / count * (R - 0.5 * the_case.parameters.h()) / sigma;
  RecordProperty("pressure_over_exact", std::to_string(found));
  EXPECT_NEAR(found, 1.0, 0.05);
  EXPECT_LT(solver.kinetic_energy(), 1e-4 * 2 * std::numbers::pi * R * sigma) << "it does not stir itself";
}

}  // namespace
}  // namespace toryu::fluid
