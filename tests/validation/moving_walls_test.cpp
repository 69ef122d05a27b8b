// A rolling tank and a swinging disc at two spacings each; the finer ones are in moving_walls_long_test.
#include "tests/validation/moving_walls.hpp"

namespace toryu::fluid {
namespace {

void record(const std::string& name, double value) {
  ::testing::Test::RecordProperty(name, fmt::format("{:.5f}", value));
}

TEST(SloshingTank, FollowsLinearTheoryBelowResonance) {
  const double coarse = sloshing_error(0.05), fine = sloshing_error(0.025);
  record("error_0.05", coarse), record("error_0.025", fine);
  EXPECT_LT(fine, 0.05);
  EXPECT_LT(fine, coarse);
}

TEST(TurningDisc, HasTheTorqueOfStokesLayer) {
  const double coarse = torque_error(0.02), fine = torque_error(0.01);
  record("error_0.02", coarse), record("error_0.01", fine);
  EXPECT_LT(fine, 0.03);
  EXPECT_LT(fine, 0.7 * coarse);
}

}  // namespace
}  // namespace toryu::fluid
