// The throat of cases/abrasive_throat by implicit steps, 20 particles across, against a staggered-grid Stokes
// solution.
#include <gtest/gtest.h>

#include "tests/validation/fluid_case.hpp"

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

}  // namespace
}  // namespace toryu::fluid
