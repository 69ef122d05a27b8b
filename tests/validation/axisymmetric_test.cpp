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

TEST(AxisymmetricTube, FlowsAsFastAsItsPressesMakeIt) {
  const FluidCase the_case("axisymmetric_tube/pressed.toml");
  WeaklyCompressible solver = the_case.solver();
  run_until(solver, 0.018);
  const double before = mean_way(solver);
  run_until(solver, 0.03);
  // 6.4 MPa over 16 mm at 400 MPa/m for 50 mm/s
  EXPECT_NEAR((mean_way(solver) - before) / 0.012, 0.05, 0.02 * 0.05);
}

}  // namespace
}  // namespace toryu::fluid
