// cases/power_law_channel at its own spacing.
#include <gtest/gtest.h>

#include "tests/validation/channel.hpp"

namespace toryu::fluid {
namespace {

TEST(PowerLawChannel, HasThePressureDropAndProfileOfAPowerLaw) {
  const double w = channel_width, U = mean_velocity;
  const FluidCase the_case("power_law_channel");
  const PowerLaw& law = *the_case.parameters.power_law;
  const double n = law.exponent, wall_rate = (2 * n + 1) / (3 * n) * 6 * U / w;
  const DevelopedFlow exact(viscosity_of(the_case.parameters), w, U);
  expect_within_two_percent(run_channel(the_case, exact), -2 * law.consistency * std::pow(wall_rate, n) / w);
}

}  // namespace
}  // namespace toryu::fluid
