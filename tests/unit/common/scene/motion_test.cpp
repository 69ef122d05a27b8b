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

// A table of positions: slopes (0, 0), (1, 2), (-0.5, -1) and (0, 0) at its rows.
const Motion measured{.position = {{0, 5, 5}, {1, 6, 7}, {2, 7, 9}, {3, 5, 5}}};

TEST(Motion, OfPositionsIsCubicAndAtRestAtItsEnds) {
  EXPECT_EQ(measured.displacement_at(1), Vec(1, 2)) << "the change counts";
  EXPECT_EQ(measured.displacement_at(0.5), Vec(0.375, 0.75));
  EXPECT_EQ(measured.velocity_at(0.5), Vec(1.25, 2.5));
  EXPECT_EQ(measured.displacement_at(1.5), Vec(1.6875, 3.375));
  EXPECT_EQ(measured.velocity_at(1.5), Vec(1.375, 2.75));
  for (const double t : {-1.0, 0.0, 3.0, 9.0}) EXPECT_EQ(measured.velocity_at(t), Vec(0, 0)) << t;
  for (const double row : {1.0, 2.0})
    EXPECT_LT((measured.velocity_at(row - 1e-9) - measured.velocity_at(row)).norm(), 1e-7) << row;
}

TEST(Motion, OfPositionsThatMayJumpIsLinear) {
  Motion straight = measured;
  straight.jumps = true;
  EXPECT_EQ(straight.displacement_at(0.5), Vec(0.5, 1));
  EXPECT_EQ(straight.velocity_at(0.5), Vec(1, 2));
  EXPECT_EQ(straight.velocity_at(2.5), Vec(-2, -4));
}

TEST(Motion, ASineBeginsByItsRamp) {
  const Sine sine{.amplitude = 2, .frequency = 0.25, .ramp = 2};
  EXPECT_EQ(sine.value_at(0), 0);
  EXPECT_EQ(sine.rate_at(0), 0);
  EXPECT_NEAR(sine.value_at(1), 2 * 0.5, 1e-14);
  EXPECT_NEAR(sine.rate_at(1), 2 * 0.9375, 1e-14);
  EXPECT_NEAR(sine.value_at(3), -2, 1e-14);
  EXPECT_NEAR(sine.rate_at(3), 0, 1e-14);
  const Motion shaken{.sine = {{{sine, Vec(3, 4)}}}};
  EXPECT_LT((shaken.displacement_at(3) - Vec(-1.2, -1.6)).norm(), 1e-14) << "along a line";
}

TEST(Motion, ASineWithoutARampCountsFromWhereTheBodyIsDrawn) {
  const Motion shaken{.sine = {{{{.amplitude = 2, .frequency = 0.25, .phase = M_PI / 2}, Vec(1, 0)}}}};
  EXPECT_NEAR(shaken.displacement_at(0)[0], 0, 1e-14);
  EXPECT_NEAR(shaken.displacement_at(2)[0], -4, 1e-14);
}

TEST(Motion, TurnsAboutAPointThatMoves) {
  // a quarter turn in a second about (1, 0), which moves by (2, 0)
  const Motion wheel{.velocity = {{0, 2, 0}},
                     .rotation = Rotation{Vec(1, 0), {.angle = {{0, 0}, {1, M_PI / 2}}, .jumps = true}}};
  const Pose later = wheel.pose_at(1 - 1e-15);
  EXPECT_LT((later.place(Vec(2, 0)) - Vec(3, 1)).norm(), 1e-13);
  EXPECT_LT((later.velocity_of(Vec(2, 0)) - Vec(2 - M_PI / 2, 0)).norm(), 1e-13);
  EXPECT_LT((later.turned(Vec(0, 1)) - Vec(-1, 0)).norm(), 1e-13);
  EXPECT_LT((wheel.pose_at(0.5).place(Vec(1, 0)) - Vec(2, 0)).norm(), 1e-14);
}

TEST(Motion, AnglesAddUp) {
  const Turning turning{.angle = {{0, 1}, {1, 2}, {2, 3}, {3, 1}},
                        .angular_velocity = {{0, 0}, {2, 4}},
                        .sine = {{{.amplitude = 2, .frequency = 0.25, .ramp = 2}}}};
  EXPECT_NEAR(turning.angle_at(1), 1 + 1 + 1, 1e-14);
  EXPECT_NEAR(turning.rate_at(1), 1 + 2 + 1.875, 1e-14);
  EXPECT_NEAR(turning.angle_at(3), 0 + 8 - 2, 1e-13);
  EXPECT_NEAR(turning.rate_at(3), 4, 1e-13);
}

TEST(Motion, ExtremesAreThoseOfTheOutermostPoint) {
  const Motion shaken{.sine = {{{{.amplitude = 0.1, .frequency = 2}, Vec(0, 1)}}}, .jumps = true};
  const double omega = 4 * M_PI;
  const MotionExtremes found = extremes(shaken, {Vec(7, 7)}, 1.7);
  EXPECT_NEAR(found.most[1], 0.1, 1e-4);
  EXPECT_NEAR(found.least[1], -0.1, 1e-4);
  EXPECT_NEAR(found.speed, 0.1 * omega, 1e-12);
  EXPECT_NEAR(found.acceleration, 0.1 * omega * omega, 1e-3 * 0.1 * omega * omega);
  const Motion wheel{.rotation = Rotation{Vec(1, 0), {.angular_velocity = {{0, -3}}}}};
  const MotionExtremes turned = extremes(wheel, {Vec(1, 0.5), Vec(1, -2)}, 10);
  EXPECT_NEAR(turned.speed, 6, 1e-12);
  EXPECT_NEAR(turned.least_angle, -30, 1e-12);
}

TEST(GravityChange, IsAddedAndTurned) {
  const GravityChange change{.acceleration = {{0, 1, 0}, {1, 3, 0}},
                             .sine = {{{{.amplitude = 2, .frequency = 0.25, .ramp = 2}, Vec(0, 1)}}},
                             .turning = Turning{.angle = {{0, 0}, {1, M_PI / 2}}, .jumps = true}};
  EXPECT_LT((change.at(Vec(0, -9), 0) - Vec(1, -9)).norm(), 1e-14);
  EXPECT_LT((change.at(Vec(0, -9), 1) - Vec(9 - 1, 3)).norm(), 1e-14);
}

}  // namespace
}  // namespace toryu
