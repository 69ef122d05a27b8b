// Pistons that are pressed: what flows through a throat, and the pressure that stands before and behind it.
#include <gtest/gtest.h>

#include "tests/validation/pressed_throat.hpp"

namespace toryu::fluid {
namespace {

PressedThroat expect_pressed(const char* name, double interval) {
  const PressedThroat flow = run_pressed_throat(
      FluidCase(std::string("abrasive_throat/") + name, {"fluid.spacing=0.0001"}), interval);
  testing::Test::RecordProperty("drop_over_reference", std::to_string(flow.drop));
  testing::Test::RecordProperty("upstream", std::to_string(flow.upstream));
  testing::Test::RecordProperty("downstream", std::to_string(flow.downstream));
  EXPECT_NEAR(flow.drop, 1, 0.02);
  EXPECT_NEAR(flow.upstream, 0, 0.02);
  EXPECT_NEAR(flow.downstream, 0, 0.02);
  return flow;
}

TEST(PressedThroat, HasThePressuresOfItsPressAndTheirFlowAtTwentyAcross) {
  expect_pressed("pressed.toml", 0.002);
}

TEST(ImplicitPressedThroat, HasThePressuresOfItsPressAndTheirFlowAtTwentyAcross) {
  const PressedThroat flow = expect_pressed("implicit_pressed.toml", 0.008);
  RecordProperty("mean", std::to_string(flow.mean));
  EXPECT_NEAR(flow.mean, 0, 0.01);
}

}  // namespace
}  // namespace toryu::fluid
