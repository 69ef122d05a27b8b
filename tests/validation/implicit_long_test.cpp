// By implicit steps: the throat of cases/abrasive_throat, 20 particles across, against a staggered-grid
// Stokes solution, and media that slide (cases/abrasive_slip).
#include <gtest/gtest.h>

#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

/// Between the observers, mean of the rows from `from` to `to` [s] [Pa].
double mean_drop(const std::string& name, double from, double to) {
  const FluidCase the_case("abrasive_throat/" + name, {"fluid.spacing=1e-4"});
  const auto model = make_model(the_case.parameters, the_case.scene);
  const double interval = 0.008;  // of the case's rows, whole steps
  double sum = 0;
  int samples = 0;
  for (double time = interval; time < to + 1e-9; time += interval) {
    run_until(*model, time);
    if (time < from) continue;
    for (const auto& column : model->observe()) {
      if (column.name == "pressure_upstream") sum += column.value;
      if (column.name == "pressure_downstream") sum -= column.value;
    }
    ++samples;
  }
  return sum / samples;
}

TEST(ImplicitThroat, HasThePressureDropOfTheStokesFlow) {
  const double drop = mean_drop("implicit.toml", 0.3, 0.4);
  RecordProperty("pressure_drop", std::to_string(drop));
  EXPECT_NEAR(drop, 0.708e6, 0.02 * 0.708e6);
}

TEST(ImplicitThroat, HasThePressureDropOfAPowerLaw) {
  // While the pistons are within 0.65 mm of the middle of their way, where stokes_reference.py has 1.397
  // MPa; 1.376 a millimetre off.
  const double drop = mean_drop("implicit_power_law.toml", 0.16, 0.28), reference = 1.391e6;
  RecordProperty("pressure_drop", std::to_string(drop));
  EXPECT_NEAR(drop, reference, 0.02 * reference);
}

TEST(ImplicitSlipLong, HasThePressureDropAndSlipOfLessAndMoreSlipAndOfAPowerLaw) {
  for (const char* b : {"1e-7", "1e-6"})
    expect_sliding("implicit.toml", 1e-4, 0.02, 0.02, {std::string("fluid.wall_slip.coefficient=") + b});
  expect_sliding("implicit_power_law.toml", 1e-4, 0.02, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
