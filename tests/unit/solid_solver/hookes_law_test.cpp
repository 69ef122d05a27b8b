// Patch tests of the updated form's law, in steps as both integrators take them, against exact solutions.
#include "solid_solver/terms/hookes_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "samples.hpp"

namespace toryu::solid {
namespace hookes_law_test {

using Stress2 = Symmetric<double>;
using Gradient = Tensor<double>;
const HookesLaw law{4e6, 7e5, 1000};

/// One step of length dt [s] with a constant velocity gradient.
using Step = std::function<Stress2(const Stress2&, const Gradient&, double)>;
Stress2 plus(const Stress2& s, const Stress2& ds, double dt) {
  return {s.xx + dt * ds.xx, s.yy + dt * ds.yy, s.xy + dt * ds.xy};
}
Stress2 midpoint(const Stress2& s, const Gradient& g, double dt) {
  return plus(s, law.rate(plus(s, law.rate(s, g), 0.5 * dt), g), dt);
}
Stress2 symplectic(const Stress2& s, const Gradient& g, double dt) {
  return law.after(s, g, dt);
}
Stress2 run(const Step& step, Stress2 s, const Gradient& g, int steps) {
  for (int n = 0; n < steps; ++n) s = step(s, g, 1.0 / steps);
  return s;
}
double distance(const Stress2& a, const Stress2& b) {
  return std::sqrt(std::pow(a.xx - b.xx, 2) + std::pow(a.yy - b.yy, 2) + 2 * std::pow(a.xy - b.xy, 2));
}

TEST(HookesLaw, StressTurnsWithTheBodyAndTheErrorPerTurnFallsWithTheSquareOfTheStep) {
  const double omega = 2 * M_PI;  // a turn in 1 s
  const Gradient turn{0, -omega, omega, 0};
  const Stress2 start{3e4, -1e4, 5e3};
  for (const Step& step : {Step(midpoint), Step(symplectic)}) {
    const double coarse = distance(run(step, start, turn, 200), start),
                 fine = distance(run(step, start, turn, 800), start);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2.0, 0.02);
    const Stress2 quarter = run(step, start, {0, -omega / 4, omega / 4, 0}, 800);
    EXPECT_LT(distance(quarter, {start.yy, start.xx, -start.xy}), 1e-4 * 3e4);
  }
  const auto size = [](const Stress2& s) { return distance(s, {0, 0, 0}); };
  EXPECT_NEAR(size(run(symplectic, start, turn, 10)) / size(start), 1.0, 1e-13) << "in few steps too";
  EXPECT_GT(size(run(midpoint, start, turn, 10)) / size(start), 1.5) << "midpoint does not keep it";
}

TEST(HookesLaw, LargeShearIsASineOfTheAngle) {
  // The Jaumann rate in simple shear v_x = gamma y: ds_xy = G gamma - gamma (s_xx - s_yy)/2 and so on.
  const double gamma = 6.0;
  const Gradient shear{0, gamma, 0, 0};
  for (const Step& step : {Step(midpoint), Step(symplectic)}) {
    const Stress2 s = run(step, {0, 0, 0}, shear, 4000);
    EXPECT_NEAR(s.xy / law.G, std::sin(gamma), 1e-4);
    EXPECT_NEAR(s.xx / law.G, 1 - std::cos(gamma), 1e-4);
    EXPECT_NEAR(s.yy / law.G, std::cos(gamma) - 1, 1e-4);
  }
}

/// Stress over strain of a free plate in renormalised updated form, strained at a constant rate for one step.
Stress patch(Integrator integrator, const Mat& strain) {
  Parameters p = free_plate(4);
  p.formulation = Formulation::updated_lagrangian;
  p.gradients = Gradients::renormalised;
  p.integrator = integrator;
  p.hourglass.reset();
  const double dt = 1e-9, size = 1e-6;
  const Mat rate = size / dt * strain;
  p.initial_velocity = InitialVelocity{.profile = VelocityProfile::linear,
                                       .gradient = {{rate(0, 0), rate(0, 1)}, {rate(1, 0), rate(1, 1)}}};
  const auto model = model_of(p);
  model->advance(dt);
  Stress found = model->stress(0);
  for (std::size_t i = 1; i < model->particle_count(); ++i)
    EXPECT_NEAR(model->stress(i).xx, found.xx, 1e-4 * std::abs(found.xx) + 1e-6) << "at the edge as inside";
  for (auto* component : {&found.xx, &found.yy, &found.zz, &found.xy}) *component /= size;
  return found;
}

TEST(PatchTest, UniaxialIsotropicAndShearedPlatesHaveTheStressOfHookesLaw) {
  const auto& m = free_plate(4).material;
  const double E = m.youngs_modulus, nu = m.poissons_ratio, K = m.bulk_modulus(), G = m.shear_modulus();
  Mat strain;
  for (const Integrator integrator : {Integrator::midpoint, Integrator::symplectic}) {
    strain << 1, 0, 0, -nu / (1 - nu);  // free to contract
    Stress sigma = patch(integrator, strain);
    EXPECT_NEAR(sigma.xx / (E / (1 - nu * nu)), 1, 1e-4);
    EXPECT_NEAR(sigma.yy / E, 0, 1e-4);
    EXPECT_NEAR(sigma.zz / sigma.xx, nu, 1e-3);
    strain << 1, 0, 0, 1;
    sigma = patch(integrator, strain);
    EXPECT_NEAR(sigma.xx / (2 * K + 2 * G / 3), 1, 1e-4);
    EXPECT_NEAR(sigma.yy / sigma.xx, 1, 1e-4);
    strain << 0, 1, 0, 0;
    sigma = patch(integrator, strain);
    EXPECT_NEAR(sigma.xy / G, 1, 1e-4);
  }
}

}  // namespace hookes_law_test
}  // namespace toryu::solid
