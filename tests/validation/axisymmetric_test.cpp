// Axisymmetric flow: media of 1000 Pa s through a tube, in real pascals.
#include <gtest/gtest.h>

#include "tests/validation/channel.hpp"

namespace toryu::fluid {
namespace {

TEST(AxisymmetricTube, HasThePressureDropAndProfileOfANewtonianMedium) {
  expect_passage("axisymmetric_tube/case.toml", 1.25e-4, 0.04, 0.04);
  expect_passage("axisymmetric_tube/case.toml", 1e-4, 0.02, 0.02);
}

/// How far the pressed walls have come, along x, in the mean [m].
double mean_way(const WeaklyCompressible& solver) {
  double sum = 0;
  int count = 0;
  for (const auto& boundary : solver.boundaries())
    if (const auto* pressed = std::get_if<PressedMotion>(&boundary.motion)) {
      sum += pressed->way_at(solver.time()) * pressed->press.axis()[0];
      ++count;
    }
  return sum / count;
}

// U = G R^2/(8 eta) by the gradient between the observers. That of the presses' difference would be none of a
// tube between pistons: where they slide along it the medium's stress grows as 1/r towards the corner.
TEST(AxisymmetricTube, FlowsAsFastAsItsPressesMakeIt) {
  const FluidCase the_case("axisymmetric_tube/pressed.toml");
  WeaklyCompressible solver = the_case.solver();
  run_until(solver, 0.018);
  const double before = mean_way(solver);
  double gradient = 0;
  int samples = 0;
  for (double time = 0.018; time < 0.03 - 1e-9; time += 5e-4) {
    run_until(solver, time + 5e-4);
    for (const auto& column : solver.observe()) {
      if (column.name == "pressure_upstream") gradient += column.value / 0.004;
      if (column.name == "pressure_downstream") gradient -= column.value / 0.004;
    }
    ++samples;
  }
  gradient /= samples;
  const double speed = (mean_way(solver) - before) / 0.012;
  RecordProperty("speed", std::to_string(speed));
  EXPECT_GT(speed, 0.035);
  EXPECT_NEAR(speed / (gradient * 1e-6 / 8000), 1, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
