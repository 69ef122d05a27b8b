#include "solid_solver/shape.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace toryu::solid {
namespace {

Box box(double left, double bottom, double right, double top, bool round = false) {
  return {Vec(left, bottom), Vec(right, top), round};
}

constexpr double d_0 = 0.1;

TEST(Shape, JoinsAllOfOneRegionAndOfRegionsThatTouch) {
  EXPECT_TRUE(Shape({box(0, 0, 1, 1)}, {}, d_0).joins(Vec(0.05, 0.05), Vec(0.95, 0.65)));
  const Shape two({box(0, 0, 1, 1), box(1, 0, 2, 0.3)}, {}, d_0);
  EXPECT_TRUE(two.joins(Vec(0.95, 0.25), Vec(1.05, 0.05)));
  EXPECT_TRUE(two.joins(Vec(0.95, 0.35), Vec(1.05, 0.25))) << "through the corner";
  EXPECT_TRUE(two.joins(Vec(0.95, 0.35), Vec(1.15, 0.25))) << "past the corner, hardly longer";
  EXPECT_FALSE(two.joins(Vec(0.95, 0.55), Vec(1.25, 0.25))) << "far past the corner";
}

TEST(Shape, DoesNotJoinAcrossAGapHoweverNarrow) {
  for (const double gap : {0.001, 0.03, 0.08, 0.1}) {
    const Shape two({box(0, 0, 1, 1), box(1 + gap, 0, 2 + gap, 1)}, {}, d_0);
    EXPECT_FALSE(two.joins(Vec(0.95, 0.45), Vec(1.05 + gap, 0.45))) << gap;
    EXPECT_TRUE(two.joins(Vec(0.95, 0.45), Vec(0.85, 0.35))) << gap;
  }
}

TEST(Shape, DoesNotJoinAcrossASlotButAroundItsEnd) {
  const Shape slotted({box(0, 0, 2, 1)}, {box(0, 0.5, 1, 0.502)}, d_0);
  EXPECT_FALSE(slotted.joins(Vec(0.95, 0.45), Vec(0.95, 0.55)));
  EXPECT_FALSE(slotted.joins(Vec(0.85, 0.45), Vec(0.95, 0.55))) << "slanting";
  EXPECT_TRUE(slotted.joins(Vec(0.95, 0.45), Vec(1.03, 0.55)))
      << "round the end, a hundredth of a spacing longer";
  EXPECT_TRUE(slotted.joins(Vec(1.05, 0.45), Vec(1.05, 0.55)));
  EXPECT_TRUE(slotted.joins(Vec(0.85, 0.45), Vec(0.95, 0.45))) << "along it";
}

TEST(Shape, LetsBondsFollowARoundFaceButNotCrossTheHole) {
  const Shape holed({box(-2, -2, 2, 2)}, {box(-1, -1, 1, 1, true)}, d_0);
  EXPECT_TRUE(holed.joins(Vec(1.001, -0.05), Vec(1.001, 0.05)));
  EXPECT_TRUE(holed.joins(Vec(1.001, 0.0), Vec(0.99, 0.17))) << "a chord a little inside";
  EXPECT_FALSE(holed.joins(Vec(1.05, 0), Vec(-1.05, 0)));
}

/// Largest speed of the right one of two blocks, the left one of which flies off.
double speed_of_neighbour(double gap) {
  Parameters p = free_plate(4);
  p.initial_velocity.reset();
  const double d = p.spacing;
  p.regions = {{.name = "left",
                .box = {Vec(0, 0), Vec(6 * d, 6 * d)},
                .initial_velocity = InitialVelocity{.velocity = Vec(-1, 0)}},
               {.name = "right", .box = {Vec(6 * d + gap, 0), Vec(12 * d + gap, 6 * d)}}};
  const auto model = model_of(p);
  for (int n = 0; n < 60; ++n) model->advance(model->time_step_limit());
  double fastest = 0;
  for (std::uint32_t i = 0; i < model->particle_count(); ++i)
    if (model->body().region[i] == 1) fastest = std::max(fastest, model->velocity(i).norm());
  return fastest;
}

TEST(Shape, LeavesABodyAloneThatAnotherFliesOffFrom) {
  const double d = free_plate(4).spacing;
  for (const double share : {0.1, 0.5, 0.8, 1.0, 1.5}) EXPECT_EQ(speed_of_neighbour(share * d), 0) << share;
  EXPECT_GT(speed_of_neighbour(0), 0.01) << "regions that touch are one body";
}

}  // namespace
}  // namespace toryu::solid
