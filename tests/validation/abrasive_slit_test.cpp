// A medium of 1000 Pa s between two plates at the speed and the pressure of a machine, computed at another
// density: against the slit solutions, in real pascals.
#include <gtest/gtest.h>

#include "tests/validation/channel.hpp"

namespace toryu::fluid {
namespace {

TEST(AbrasiveSlit, HasThePressureDropAndProfileOfItsRealMedium) {
  expect_passage("abrasive_slit/newtonian.toml", 2e-4, 0.04, 0.04);
  expect_passage("abrasive_slit/newtonian.toml", 1e-4, 0.02, 0.02);
}

TEST(AbrasiveSlit, HasThePressureDropAndProfileOfAPowerLaw) {
  expect_passage("abrasive_slit/case.toml", 2e-4, 0.07, 0.06);
  expect_passage("abrasive_slit/case.toml", 1e-4, 0.02, 0.02);
}

TEST(AbrasiveSlit, HasThePressureDropOfAPublishedMedium) {
  // V10 by hand: gdot_w = (2n+1)/(3n) 6U/w = 153.5 1/s, tau_w = 989 gdot_w^0.935 = 109.4 kPa
  const FluidCase the_case("abrasive_slit/c11.toml");
  EXPECT_NEAR(passage_flow(the_case.parameters, 0.05, 0.002).wall_stress, 109.43e3, 10);
  expect_passage("abrasive_slit/c11.toml", 2e-4, 0.05, 0.04);
  expect_passage("abrasive_slit/c11.toml", 1e-4, 0.02, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
