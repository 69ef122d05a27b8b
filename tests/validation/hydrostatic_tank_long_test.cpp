#include "tests/validation/hydrostatic_tank.hpp"

namespace toryu::fluid {
namespace {

TEST(HydrostaticTank, StaysAtRestForFortySeconds) {
  expect_rest({}, 40.0);
}

}  // namespace
}  // namespace toryu::fluid
