// What shows in a run alone: told once, and the end of the run where the result is spoiled.
#include "fluid_solver/run_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error/failure.hpp"
#include "tests/one_thread.hpp"
#include "tests/said.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A fluid that does well, c_0 = 20 m/s.
RunFigures well() {
  return {.time = 0.5,
          .fast = 2.99,
          .mean_density = 1000,
          .count = 2000,
          .penetration = {2, "floor", Vec(0.1, -0.2)},
          .gained = -3,
          .turned_over = 10,
          .least_energy = 1};
}

RunWatch watch() {
  return RunWatch(Limits{}, 20);
}

TEST(RunWatch, SaysNothingOfAFluidThatDoesWell) {
  const Said said;
  RunWatch of = watch();
  for (int n = 0; n < 3; ++n) of.look(well());
  EXPECT_EQ(said.text(), "");
}

TEST(RunWatch, WarnsOnceOfASpeedThatIsTooNearToThatOfSound) {
  const Said said;
  RunWatch of = watch();
  RunFigures fast = well();
  fast.fast = 3.1;
  for (int n = 0; n < 2; ++n) of.look(fast);
  EXPECT_EQ(
      said.times("t = 0.5 s: a hundredth of the fluid is faster than 3.1 m/s, 0.15 of the sound speed of 20"),
      1)
      << said.text();
  EXPECT_EQ(said.times("take [fluid] sound_speed = 31 or more"), 1) << said.text();
}

TEST(RunWatch, WarnsOfFluidInWallsAndStops) {
  const Said said;
  RunWatch of = watch();
  RunFigures inside = well();
  inside.penetration.count = 3;
  for (int n = 0; n < 2; ++n) of.look(inside);
  EXPECT_EQ(
      said.times("3 particles of the fluid are inside walls, most of them in 'floor', near (0.1, -0.2) m"), 1)
      << said.text();
  inside.penetration.count = 101;
  EXPECT_THAT([&] { of.look(inside); },
              ThrowsMessage<PhysicsFailure>(HasSubstr(
                  "particles inside walls, near (0.1, -0.2) m in 'floor', = 101, limit 0.05 of 2000")));
}

TEST(RunWatch, WarnsOfADensityThatCreepsAndStops) {
  const Said said;
  RunWatch of = watch();
  RunFigures creeping = well();
  of.look(creeping);
  for (const double density : {1029.0, 1031.0, 1032.0}) {
    creeping.mean_density = density;
    of.look(creeping);
  }
  EXPECT_EQ(said.times("the mean density of the fluid has crept from 1000 to 1031 kg/m3, by 3.1 %"), 1)
      << said.text();
  EXPECT_EQ(said.times("crept"), 1);
  creeping.mean_density = 890;
  EXPECT_THAT([&] { of.look(creeping); },
              ThrowsMessage<PhysicsFailure>(HasSubstr("change of the mean density since the start = -0.11")));
}

TEST(RunWatch, WarnsOfEnergyFromNowhereAndStops) {
  const Said said;
  RunWatch of = watch();
  RunFigures fed = well();
  of.look(fed);
  for (const double gained : {-2.0, 2.4, 2.6}) {  // since its lowest it gains 5.6, half of 10 and 1
    fed.gained = gained;
    of.look(fed);
  }
  EXPECT_EQ(said.times("the fluid has gained 5.6 J/m that no boundary gave it, 0.51 of"), 1) << said.text();
  EXPECT_EQ(said.times("has gained"), 1);
  fed.gained = 9;
  EXPECT_THAT([&] { of.look(fed); },
              ThrowsMessage<PhysicsFailure>(HasSubstr("energy from nowhere [J/m] = 12")));
}

TEST(RunWatch, RoundingAtRestIsNoEnergy) {
  const Said said;
  RunWatch of = watch();
  RunFigures rest = well();
  rest.turned_over = 0;
  rest.gained = 0.09;
  of.look(rest);
  EXPECT_EQ(said.text(), "");
}

TEST(Penetration, CountsWhoIsInAWallAndNotWhoTouchesIt) {
  Setting setting = collapsing_column();
  WeaklyCompressible solver = setting.solver();
  solver.advance(1e-6);
  Particles fluid = solver.particles();
  EXPECT_EQ(penetration(fluid, solver.boundaries()).count, 0u);
  // somebody beside the floor
  std::size_t low = 0;
  for (std::size_t i = 0; i < fluid.count; ++i)
    if (fluid.x[1][i] < 0.03 && fluid.x[0][i] > 0.2 && fluid.x[0][i] < 0.3) low = i;
  const double d_0 = setting.parameters.spacing;
  for (const double share : {0.0, 0.25, 0.5}) {  // between sites and upon them
    fluid.x[0][low] = 0.225 + share * d_0;
    fluid.x[1][low] = -0.1 * d_0;
    EXPECT_EQ(penetration(fluid, solver.boundaries()).count, 0u) << share;
    fluid.x[1][low] = -0.8 * d_0;
    const Penetration found = penetration(fluid, solver.boundaries());
    EXPECT_EQ(found.count, 1u) << share;
    EXPECT_EQ(found.boundary, "walls");
    EXPECT_NEAR(found.place[1], -0.8 * d_0, 1e-12);
  }
}

TEST(RunWatch, LooksAtTheWholeSolver) {
  Setting setting = collapsing_column();
  setting.parameters.sound_speed = 12;  // the front reaches 2 sqrt(g H), 5.6 m/s
  setting.parameters.hydrostatic_start = HydrostaticStart{0.8};
  const Said said;
  WeaklyCompressible solver = setting.solver();
  while (solver.time() < 0.25) {
    solver.advance(solver.time_step_limit());
    solver.record(solver.time());
    solver.watch(solver.time());
  }
  EXPECT_EQ(said.times("a hundredth of the fluid is faster than"), 1) << said.text();
}

}  // namespace
}  // namespace toryu::fluid
