// Axisymmetric flow: a medium of 1000 Pa s through a round throat, at the spacing of the case.
#include <gtest/gtest.h>

#include "tests/validation/axisymmetric_throat.hpp"

namespace toryu::fluid {
namespace {

TEST(AxisymmetricThroat, HasItsPressureDropAtFifteenAcrossTheRadius) {
  const double drop = run_axisymmetric_throat(FluidCase("axisymmetric_throat"));
  testing::Test::RecordProperty("pressure_drop_over_reference", std::to_string(drop));
  EXPECT_NEAR(drop, 1, 0.03);
}

}  // namespace
}  // namespace toryu::fluid
