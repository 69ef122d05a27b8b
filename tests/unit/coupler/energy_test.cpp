/// Which schemes make energy: a mass on a spring beside a column that throws all waves back.
#include <gtest/gtest.h>

#include "coupler/prediction.hpp"
#include "coupler/schemes.hpp"
#include "tests/unit/coupler/acoustic_sides.hpp"

namespace toryu::coupling {
namespace {

/// The energy left after `windows` of `steps` fluid steps of `dt`, over that of the start. The spring turns
/// the mass by `angle` in a window, in vacuum.
double left(SchemeKind scheme, double mass, double angle, double dt, int steps, int windows = 4000) {
  const double W = steps * dt;
  AcousticSides sides(mass, mass * angle * angle / (W * W), dt);
  sides.v = 1;
  Parameters parameters;
  parameters.scheme = scheme;
  parameters.fluid_steps_per_window = steps;
  const auto coupling = make_scheme(parameters, sides, sides.start());
  const double first = sides.energy();
  Window window{.dt = W};
  for (int n = 0; n < windows && sides.energy() < 1e6 * first; ++n, window.time += W) {
    ++window.number;
    coupling->compute(window);
  }
  return sides.energy() / first;
}

constexpr double angles[] = {0.1, 0.3, 1.0, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0, 8.0};

TEST(SerialRobinRun, MakesNoEnergyWhateverTheModeAndTheMass) {
  for (const double mass : {4.0, 1.0, 0.37, 0.1})
    for (const double angle : angles)
      EXPECT_LT(left(SchemeKind::serial_robin, mass, angle, 0.28, 1), 1)
          << "mass " << mass << ", angle " << angle;
}

TEST(SerialRobin, BearsLongerStepsOfAMassThatIsNotLight) {
  for (const double angle : angles)
    EXPECT_LT(left(SchemeKind::serial_robin, 4, angle, 0.56, 1), 1) << "angle " << angle;
}

TEST(SerialExplicit, FeedsAModeThatTurnsByAQuarterInAWindow) {
  EXPECT_GT(left(SchemeKind::serial_explicit, 1, 1.0, 0.28, 1), 1e6);
  EXPECT_GT(left(SchemeKind::serial_explicit, 0.1, 0.3, 0.28, 1), 1e6);
}

TEST(SerialRobin, GivesBackTheImpulseThatTheImpedanceTook) {
  AcousticSides sides(1, 4, 0.28);
  sides.v = 1;
  const Parameters parameters;
  const auto coupling = make_scheme(parameters, sides, sides.start());
  Window window{.dt = 0.28};
  std::vector<double> taken;
  for (int n = 0; n < 5; ++n, window.time += window.dt) {
    ++window.number;
    const Exchange done = coupling->compute(window);
    if (n == 0)
      EXPECT_EQ(done.returned[0], 0);
    else
      EXPECT_EQ(done.returned, taken);
    taken = done.solid.motion.impulse;
    EXPECT_NE(taken[0], 0);
    // z (w_c dt - dx), for the mass moved from interface_start
    EXPECT_EQ(done.applied.impedance[0], 2 * done.fluid.load.impedance[0]);
    EXPECT_NEAR(
        taken[0] / done.applied.impedance[0],
        done.applied.velocity[0] * window.dt - (done.solid.motion.position[0] - done.interface_start[0]),
        1e-14);
    const double force = done.applied.force[0] * window.dt;
    EXPECT_NEAR(done.fluid.load.impulse_on_fluid[0], -force - done.returned[0], 1e-15);
    EXPECT_NEAR(done.solid.impulse_taken[0], force + taken[0], 1e-15);
  }
}

TEST(SerialRobin, PassesNoImpedanceOnWithoutPressure) {
  AcousticSides sides(1, 4, 0.28);
  sides.v = 1;
  Parameters parameters;
  parameters.loads = {"friction"};
  const auto coupling = make_scheme(parameters, sides, sides.start());
  Window window{.number = 1, .dt = 0.28};
  const Exchange done = coupling->compute(window);
  EXPECT_EQ(done.applied.impedance[0], 0);
  EXPECT_EQ(done.solid.impulse_taken[0], 0);
}

TEST(Prediction, IsTheMeanVelocityOfASteadyAcceleration) {
  const double tau = 2;
  Prediction prediction({{0, 0}, {0, 0}}, tau);
  EXPECT_EQ(prediction.over(0.5).velocity[0], 0);
  double v = 0;
  for (int n = 0; n < 200; ++n) prediction.note({{0, 0}, {v += 0.5 * 3, 0}}, 0.5);  // 3 m/s2
  EXPECT_NEAR(prediction.over(0.5).velocity[0], v + 0.25 * 3, 1e-9);
  EXPECT_NEAR(prediction.over(0.5).position[0], 0.5 * (v + 0.25 * 3), 1e-9);
}

TEST(Prediction, DoesNotGoOnWithAChangeOfAWindow) {
  Prediction prediction({{0, 0}, {0, 0}}, 4.5);
  prediction.note({{0, 0}, {1, 0}}, 0.5);  // an acceleration of 2, of which a tenth counts
  EXPECT_DOUBLE_EQ(prediction.over(0.5).velocity[0], 1 + 0.25 * 0.2);
}

}  // namespace
}  // namespace toryu::coupling
