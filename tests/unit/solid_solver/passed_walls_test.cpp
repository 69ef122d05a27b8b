#include "solid_solver/passed_walls.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "samples.hpp"
#include "tests/said.hpp"

namespace toryu::solid {
namespace {

const std::vector<Vec> row{Vec(0, 0), Vec(1, 0), Vec(2, 0)};

std::vector<Vec> moved_by(const Vec& way) {
  std::vector<Vec> x = row;
  for (Vec& x_i : x) x_i += way;
  return x;
}

TEST(PassedWalls, AreToldOnceWithPlaceAndTime) {
  const Said said;
  PassedWalls walls({{"roof", {Vec(-1, 3), Vec(5, 4)}, {}}, {"floor", {Vec(1.5, -4), Vec(5, -1)}, {}}}, row,
                    0.5);
  walls.check(moved_by(Vec(0, -0.5)), 0.1);
  EXPECT_EQ(said.text(), "");
  for (int n = 0; n < 2; ++n) walls.check(moved_by(Vec(0, -1.5)), 0.25);
  EXPECT_EQ(
      said.times("the solid passes through wall 'floor': particle 2 is in it at (2, -1.5) m, t = 0.25 s; "
                 "[solid.wall_contact] makes them touch"),
      1)
      << said.text();
  EXPECT_EQ(said.times("passes"), 1) << said.text();
}

TEST(PassedWalls, MayHoldParticlesFromTheStart) {
  const Said said;
  PassedWalls walls({{"root", {Vec(-1, -1), Vec(0.5, 1)}, {}}}, row, 0.5);
  walls.check(moved_by(Vec(0.1, 0)), 0.1);
  EXPECT_EQ(said.text(), "") << "particle 0 stands in it from the start";
  walls.check(moved_by(Vec(-0.8, 0)), 0.2);
  EXPECT_EQ(said.times("particle 1 is in it"), 1) << said.text();
}

/// The corner of a lattice beside an arc begins nearer to it than half a spacing, and moves.
TEST(PassedWalls, HoldCellsNotPlaces) {
  const Said said;
  PassedWalls walls({{"pin", {Vec(2.1, -1), Vec(4.1, 1), true}, {}}}, row, 0.5);
  walls.check(moved_by(Vec(0.2, 0)), 0.1);
  EXPECT_EQ(said.text(), "");
  walls.check(moved_by(Vec(0.5, 0)), 0.2);
  EXPECT_EQ(said.times("wall 'pin': particle 2"), 1) << said.text();
}

/// A wall that is drawn above the row, goes 3 m down in a second and turns by a quarter then.
TEST(PassedWalls, AreWhereTheirMotionHasBroughtThem) {
  Wall wall{"press", {Vec(-0.5, 3), Vec(2.5, 4)}, Motion{.velocity = {{0, 0, -3}}}};
  {
    const Said said;
    PassedWalls walls({wall}, row, 0.5);
    walls.check(row, 0.9);
    EXPECT_EQ(said.text(), "");
    walls.check(row, 1.1);
    EXPECT_EQ(said.times("wall 'press': particle 0"), 1) << said.text();
  }
  wall.motion->rotation =
      Rotation{.about = Vec(1, 3.5), .turning = {.angle = {{0, 0}, {1, std::numbers::pi / 2}}}};
  const Said said;
  PassedWalls walls({wall}, row, 0.5);
  walls.check(row, 1.1);
  EXPECT_EQ(said.times("wall 'press': particle 1"), 1)
      << "upright, it is from x = 0.5 to 1.5 m: " << said.text();
}

TEST(PassedWalls, AreThoseThatNothingMakesTheSolidTouch) {
  Scene scene = empty_scene();
  scene.walls = {{"wall", {Vec(0.09, -1), Vec(0.2, 1)}, {}}};
  Parameters p = free_plate(4);  // 0.08 m long
  p.initial_velocity = InitialVelocity{.velocity = Vec(5, 0)};
  for (const bool touch : {false, true}) {
    const Said said;
    if (touch) p.wall_contact = Contact{};
    run_to(*model_of(p, scene), 6e-3);
    EXPECT_EQ(said.times("the solid passes through wall 'wall'"), touch ? 0 : 1) << said.text();
  }
}

}  // namespace
}  // namespace toryu::solid
