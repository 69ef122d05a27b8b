// A medium that slides along its plates at the pressures of a machine: against the slit solutions with slip
// and Coulomb's duct, in real pascals; and that what comes off does not hang on the spacing.
#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

TEST(AbrasiveSlip, SolutionIsTheOneByHand) {
  // U = G (b w/2 + w^2/(12 mu)), u_s = b G w/2
  const DevelopedFlow exact = exact_of("case.toml");
  EXPECT_NEAR(-exact.pressure_gradient(), 0.05 / (3e-7 * 1e-3 + 4e-6 / 12e3), 1e-5 * 78.9e6);
  EXPECT_NEAR(exact.slip_speed(), 3e-7 * 1e-3 * 78.947368e6, 1e-7);
  const DevelopedFlow power = exact_of("power_law.toml");
  EXPECT_NEAR(-power.pressure_gradient(), 160.8e6, 0.1e6);
  EXPECT_NEAR(power.slip_speed(), 28.4e-3, 0.05e-3);
}

TEST(AbrasiveSlip, HasThePressureDropAndSlipOfANewtonianMedium) {
  expect_sliding("case.toml", 1e-4, 0.02, 0.02);  // b 3e-7 m/(Pa s); less and more in the long tests
}

TEST(AbrasiveSlip, HasThePressureDropAndSlipOfAPowerLawAtTenAcross) {
  expect_sliding("power_law.toml", 2e-4, 0.06, 0.04);
}

TEST(AbrasiveSlip, RemovesWhateverTheSpacing) {
  const double coarse = run_abrasive_slip("case.toml", 2e-4).removed_depth,
               fine = run_abrasive_slip("case.toml", 1e-4).removed_depth;
  RecordProperty("depth_at_10_over_20_across", std::to_string(coarse / fine));
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(coarse / fine, 1, 0.05);
}

TEST(CoulombDuct, RulesWhereItIsLessThanTheSlipLaw) {
  // mu_A p is 50 kPa in the middle, and the law's own shear stress 115 kPa
  const std::vector<std::string> slip{"fluid.wall_model={slip=\"no_slip\", extrapolation=\"fit\"}",
                                      "fluid.wall_slip={coefficient=1e-7}"};
  const SlidingFlow flow = run_abrasive_slip("coulomb.toml", 2e-4, slip);
  RecordProperty("log_slope_and_slip",
                 std::to_string(flow.log_slope) + " " + std::to_string(flow.slip_speed));
  EXPECT_NEAR(flow.log_slope, -50, 1);
  EXPECT_NEAR(flow.slip_speed, 0.05 - flow.wall_stress * 2e-3 / 6e3, 0.02 * 0.05)
      << "u_s = U - tau_w w/(6 mu)";
}

}  // namespace
}  // namespace toryu::fluid
