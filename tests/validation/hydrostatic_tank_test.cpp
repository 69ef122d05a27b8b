// The tank at half the resolution and for a tenth of the time; the whole is hydrostatic_tank_long_test.
#include "tests/validation/hydrostatic_tank.hpp"

namespace toryu::fluid {
namespace {

TEST(HydrostaticTank, StaysAtRestForFourSeconds) {
  expect_rest({}, 4.0);
}

}  // namespace
}  // namespace toryu::fluid
