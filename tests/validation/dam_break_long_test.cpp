#include "tests/validation/dam_break.hpp"

namespace toryu::fluid {
namespace {

TEST(DamBreak, FollowsMartinAndMoyceWithinFivePercent) {
  const Fit fit = run_dam_break({});
  EXPECT_LT(fit.root_mean_square, 0.035);
  EXPECT_LT(fit.largest, 0.05);
}

TEST(DamBreak, StrikesTheFarWallLikeAFinerOne) {
  // pressure over rho g H 30 mm high, against T = t sqrt(g/H): De Courcy et al. 2024, H/400
  WeaklyCompressible solver = FluidCase("dam_break/impact.toml", {"fluid.spacing=0.02"}).solver();
  const double H = 0.3, g = 9.81;
  double arrival = 0, sum = 0, duration = 0;
  while (solver.time() < 5 * std::sqrt(H / g)) {
    const double dt = solver.time_step_limit();
    solver.advance(dt);
    const double T = solver.time() * std::sqrt(g / H);
    for (const auto& seen : solver.observe()) {
      if (seen.name != "pressure_30mm") continue;
      const double P = seen.value / (1000 * g * H);
      if (arrival == 0 && P > 0.2) arrival = T;
      if (T > 3.2) sum += dt * P;
      if (T > 3.2) duration += dt;
    }
  }
  EXPECT_NEAR(arrival, 2.475, 0.05);
  EXPECT_NEAR(sum / duration, 0.825, 0.05);
}

}  // namespace
}  // namespace toryu::fluid
