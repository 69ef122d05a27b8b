// A medium that slides along plates and a tube: a power law, less and more slip, and Coulomb's duct.
#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

TEST(AbrasiveSlipLong, HasThePressureDropAndSlipOfAPowerLaw) {
  expect_sliding("power_law.toml", 1e-4, 0.02, 0.02);
}

TEST(AbrasiveSlipLong, HasThePressureDropOfLessAndMoreSlip) {
  for (const char* b : {"1e-7", "1e-6"})
    expect_sliding("case.toml", 1e-4, 0.02, 0.02, {std::string("fluid.wall_slip.coefficient=") + b});
  expect_sliding("axisymmetric_tube/slip.toml", 1e-4, 0.02, 0.02, {"fluid.wall_slip.coefficient=1e-7"});
}

TEST(CoulombDuct, LosesItsPressureByTheExponential) {
  const SlidingFlow flow = run_abrasive_slip("coulomb.toml", 1e-4);
  RecordProperty("log_slope", std::to_string(flow.log_slope));
  EXPECT_NEAR(flow.log_slope, -2 * 0.05 / 2e-3, 0.5);
}

TEST(AxisymmetricCoulombDuct, LosesItsPressureByTheExponential) {
  const SlidingFlow flow = run_abrasive_slip("axisymmetric_tube/coulomb.toml", 1e-4);
  testing::Test::RecordProperty("log_slope", std::to_string(flow.log_slope));
  EXPECT_NEAR(flow.log_slope, -4 * 0.025 / 2e-3, 0.5);
}

}  // namespace
}  // namespace toryu::fluid
