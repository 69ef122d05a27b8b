// The slits of cases/abrasive_slit and cases/abrasive_slip by implicit steps, at the medium's own density and
// in real pascals.
#include "fluid_solver/implicit/implicit.hpp"

#include <gtest/gtest.h>

#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

/// Gradient over the exact one.
double expect_slit(const std::string& name, double spacing, double gradient_error, double profile_error) {
  const FluidCase the_case("abrasive_slit/" + name, {"fluid.spacing=" + std::to_string(spacing)});
  const DevelopedFlow exact(viscosity_of(the_case.parameters), 0.002, 0.05);
  return expect_developed(the_case, exact, 1e-3, gradient_error, profile_error);
}

TEST(ImplicitSlit, HasThePressureDropAndProfileOfItsRealMedium) {
  const double coarse = expect_slit("implicit_newtonian.toml", 2e-4, 0.06, 0.07);
  const double fine = expect_slit("implicit_newtonian.toml", 1e-4, 0.02, 0.02);
  EXPECT_LT(std::abs(fine - 1), 0.5 * std::abs(coarse - 1));
}

TEST(ImplicitSlit, HasThePressureDropAndProfileOfAPowerLaw) {
  expect_slit("implicit.toml", 1e-4, 0.02, 0.02);
}

TEST(ImplicitSlip, HasThePressureDropAndSlipAndRemovesWhateverTheSpacing) {
  const double fine = expect_sliding("implicit.toml", 1e-4, 0.02, 0.02).removed_depth,
               coarse = run_abrasive_slip("implicit.toml", 2e-4).removed_depth;
  RecordProperty("depth_at_10_over_20_across", std::to_string(coarse / fine));
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(coarse / fine, 1, 0.05);
}

/// Products of the matrix that a run takes, by the largest viscosity of its medium.
double products_taken(const std::string& largest_viscosity) {
  const FluidCase the_case("abrasive_slit/implicit.toml",
                           {"fluid.spacing=2e-4", "fluid.power_law.largest_viscosity=" + largest_viscosity});
  Implicit model(the_case.parameters, the_case.scene);
  run_until(model, the_case.scene.end_time);
  const auto figures = model.figures();  // a product each iteration and update
  return figures.at(0).second + figures.at(1).second;
}

TEST(ImplicitSlit, CostsHardlyMoreWhereTheViscositySpansAThousand) {
  const double ratio = products_taken("1e6") / products_taken("16000");
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_LT(ratio, 1.3);
}

}  // namespace
}  // namespace toryu::fluid
