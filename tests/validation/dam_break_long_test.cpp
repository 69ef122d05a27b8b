#include "tests/validation/dam_break.hpp"

namespace toryu::fluid {
namespace {

TEST(DamBreak, FollowsMartinAndMoyceWithinFivePercent) {
  const Fit fit = run_dam_break({});
  EXPECT_LT(fit.root_mean_square, 0.035);
  EXPECT_LT(fit.largest, 0.05);
}

}  // namespace
}  // namespace toryu::fluid
