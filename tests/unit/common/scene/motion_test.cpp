#include <gtest/gtest.h>

#include "common/scene/scene.hpp"

namespace toryu {
namespace {

// At rest until 1 s, up to 2 m/s at 2 s, then sideways at 3.
const Motion piston{{{1, 0, 0}, {2, 0, 2}, {3, 4, 2}}};

TEST(Motion, IsLinearBetweenRowsAndConstantBeyond) {
  EXPECT_EQ(piston.velocity_at(-1), Vec(0, 0));
  EXPECT_EQ(piston.velocity_at(1.5), Vec(0, 1));
  EXPECT_EQ(piston.velocity_at(2), Vec(0, 2));
  EXPECT_EQ(piston.velocity_at(2.25), Vec(1, 2));
  EXPECT_EQ(piston.velocity_at(7), Vec(4, 2));
}

TEST(Motion, AccelerationIsThatOfATimeAndNotOfAnInstant) {
  EXPECT_EQ(piston.mean_acceleration(0.5, 0.25), Vec(0, 0));
  EXPECT_EQ(piston.mean_acceleration(1, 0.25), Vec(0, 1));
  EXPECT_EQ(piston.mean_acceleration(1.5, 0.25), Vec(0, 2));
  EXPECT_EQ(piston.mean_acceleration(2, 0.25), Vec(2, 1));
  const Motion stops{{{0, 1, 0}, {2, 1, 0}, {2.0000001, 0, 0}}};
  EXPECT_NEAR(stops.mean_acceleration(2.00000005, 0.25)[0], -4, 1e-9) << "not -1e7";
}

TEST(Motion, DisplacementIsTheExactIntegral) {
  EXPECT_EQ(piston.displacement_at(0), Vec(0, 0));
  EXPECT_EQ(piston.displacement_at(1.5), Vec(0, 0.25));
  EXPECT_EQ(piston.displacement_at(2), Vec(0, 1));
  EXPECT_EQ(piston.displacement_at(2.5), Vec(0.5, 2));
  EXPECT_EQ(piston.displacement_at(5), Vec(2 + 8, 1 + 2 + 4));
}

TEST(Motion, DisplacementCountsFromZeroWhereverTheTableStarts) {
  const Motion early{{{-2, 1, 0}, {-1, 3, 0}}};
  EXPECT_EQ(early.displacement_at(0), Vec(0, 0));
  EXPECT_EQ(early.displacement_at(2), Vec(6, 0));
  EXPECT_EQ(early.displacement_at(-1), Vec(-3, 0));
  EXPECT_EQ(early.displacement_at(-2), Vec(-5, 0));
  const Motion late{{{1, 1, 0}, {2, 3, 0}}};
  EXPECT_EQ(late.displacement_at(1), Vec(1, 0));
  EXPECT_EQ(late.displacement_at(2), Vec(3, 0));
  EXPECT_EQ(late.displacement_at(-1), Vec(-1, 0));
}

TEST(Motion, TwiceAsFastInHalfTheTimeHasTheSameStroke) {
  Motion fast = piston;
  fast.speed = 2;
  fast.time = 0.5;
  EXPECT_EQ(fast.velocity_at(0.75), 2 * piston.velocity_at(1.5));
  EXPECT_EQ(fast.mean_acceleration(0.75, 0.125), 4 * piston.mean_acceleration(1.5, 0.25));
  EXPECT_EQ(fast.displacement_at(1.5), piston.displacement_at(3));
  fast.time = 1;
  EXPECT_EQ(fast.displacement_at(3), 2 * piston.displacement_at(3));
  EXPECT_EQ(fast.mean_acceleration(1.5, 0.25), 2 * piston.mean_acceleration(1.5, 0.25));
}

TEST(Motion, OfOneRowIsConstant) {
  const Motion steady{{{5, 1, -2}}};
  EXPECT_EQ(steady.velocity_at(0), Vec(1, -2));
  EXPECT_EQ(steady.velocity_at(9), Vec(1, -2));
  EXPECT_EQ(steady.displacement_at(3), Vec(3, -6));
  EXPECT_EQ(steady.mean_acceleration(5, 0.1), Vec(0, 0));
}

}  // namespace
}  // namespace toryu
