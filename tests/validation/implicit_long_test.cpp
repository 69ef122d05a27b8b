// By implicit steps: the throat of cases/abrasive_throat, 20 particles across, against a staggered-grid
// Stokes solution, and media that slide (cases/abrasive_slip).
#include <gtest/gtest.h>

#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

TEST(ImplicitThroat, HasThePressureDropOfTheStokesFlow) {
  const FluidCase the_case("abrasive_throat/implicit.toml", {"fluid.spacing=1e-4"});
  const auto model = make_model(the_case.parameters, the_case.scene);
  double sum = 0;
  int samples = 0;
  for (double time = 0.3; time < 0.4; time += 0.004) {
    run_until(*model, time);
    double upstream = 0, downstream = 0;
    for (const auto& column : model->observe()) {
      if (column.name == "pressure_upstream") upstream = column.value;
      if (column.name == "pressure_downstream") downstream = column.value;
    }
    sum += upstream - downstream;
    ++samples;
  }
  RecordProperty("pressure_drop", std::to_string(sum / samples));
  EXPECT_NEAR(sum / samples, 0.708e6, 0.03 * 0.708e6);
}

TEST(ImplicitSlipLong, HasThePressureDropAndSlipOfLessAndMoreSlipAndOfAPowerLaw) {
  for (const char* b : {"1e-7", "1e-6"})
    expect_sliding("implicit.toml", 1e-4, 0.02, 0.02, {std::string("fluid.wall_slip.coefficient=") + b});
  expect_sliding("implicit_power_law.toml", 1e-4, 0.02, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
