// The traction that a sliding block of medium gives a work piece, over mu_A times the pressure at it.
#include <gtest/gtest.h>

#include <map>

#include "fluid_solver/terms/friction.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// The mean over t = 0.03 to 0.12 s.
double transmitted(const std::vector<std::string>& overrides) {
  const FluidCase the_case("sliding_block", overrides);
  WeaklyCompressible solver = the_case.solver();
  std::map<std::string, double> sum;
  for (int n = 15; n <= 60; ++n) {
    run_until(solver, 0.002 * n);
    for (const auto& seen : solver.observe()) sum[seen.name] += seen.value;
  }
  double length = 0;
  for (const auto& wall : the_case.scene.walls)
    if (wall.work_piece) length += wall.box.max[0] - wall.box.min[0];
  const double share = -sum["friction_from_work_piece_x"] /
                       (length * the_case.parameters.friction->coefficient * sum["pressure_at_work_piece"]);
  ::testing::Test::RecordProperty("transmitted", std::to_string(share));
  return share;
}

TEST(SlidingBlock, TransmitsTheCoefficientTimesThePressure) {
  EXPECT_NEAR(transmitted({}), 1, 0.02);
}

TEST(SlidingBlock, TransmitsAShareOfItAsPrinted) {
  // The shares are sums over lattices; the medium has left its own.
  EXPECT_NEAR(transmitted({"fluid.friction.form=as_printed"}), printed_share(CubicSpline(1.2), 1),
              0.02 * 0.22);
  EXPECT_NEAR(transmitted({"fluid.friction.form=as_printed", "fluid.smoothing_ratio=1.5"}),
              printed_share(CubicSpline(1.5), 1), 0.02 * 0.30);
}

}  // namespace
}  // namespace toryu::fluid
