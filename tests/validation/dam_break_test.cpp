// Half the resolution of the case.
#include "tests/validation/dam_break.hpp"

namespace toryu::fluid {
namespace {

TEST(DamBreak, FollowsMartinAndMoyceAtHalfResolution) {
  const Fit fit = run_dam_break({"fluid.spacing=0.0028575"});
  EXPECT_GT(fit.start, 0.1);  // so far the gate's opening took
  EXPECT_LT(fit.start, 0.5);
  EXPECT_LT(fit.root_mean_square, 0.035);
  EXPECT_LT(fit.largest, 0.06);
}

}  // namespace
}  // namespace toryu::fluid
