// The rolling tank and the swinging disc at half their spacing.
#include "tests/validation/moving_walls.hpp"

namespace toryu::fluid {
namespace {

TEST(SloshingTankLong, FollowsLinearTheoryBelowResonance) {
  const double error = sloshing_error(0.0125);
  ::testing::Test::RecordProperty("error", fmt::format("{:.5f}", error));
  EXPECT_LT(error, 0.05);
}

TEST(TurningDiscLong, HasTheTorqueOfStokesLayer) {
  const double error = torque_error(0.005);
  ::testing::Test::RecordProperty("error", fmt::format("{:.5f}", error));
  EXPECT_LT(error, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
