// Pistons that a press moves: the law of one by hand, what stops it, what of the pressure the medium knows.
#include <gtest/gtest.h>

#include "fluid_solver/held_pressure.hpp"
#include "tests/one_thread.hpp"
#include "tests/said.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

PressedMotion piston() {
  return {.press = {.pressure = {{0, 10}, {2, 30}},
                    .force = {},
                    .direction = Direction::minus_y,
                    .travel = Vec(-0.1, 0.2)},
          .start = {Vec(1, 2)},
          .area = 0.5,
          .mass = 4};
}

TEST(Press, IsLinearBetweenItsRows) {
  const Press by_pressure = piston().press;
  EXPECT_DOUBLE_EQ(by_pressure.pressure_at(-1, 0.5), 10);
  EXPECT_DOUBLE_EQ(by_pressure.pressure_at(0.5, 0.5), 15);
  EXPECT_DOUBLE_EQ(by_pressure.pressure_at(3, 0.5), 30);
  const Press by_force{.pressure = {}, .force = {{0, 10}, {2, 30}}};
  EXPECT_DOUBLE_EQ(by_force.pressure_at(0.5, 0.5), 30);
}

TEST(Press, HasTheAreaAcrossItsDirectionAndSweepsOverItsTravel) {
  Wall wall{"piston", {Vec(0, 0), Vec(0.5, 3)}, {}, piston().press};
  EXPECT_DOUBLE_EQ(pressing_area(wall), 0.5);
  const Box swept = swept_box(wall);  // downwards by 0.2, upwards by 0.1
  EXPECT_TRUE(swept.min.isApprox(Vec(0, -0.2)) || (swept.min - Vec(0, -0.2)).norm() < 1e-12);
  EXPECT_TRUE(swept.max.isApprox(Vec(0.5, 3.1)));
  wall.press->direction = Direction::plus_x;
  EXPECT_DOUBLE_EQ(pressing_area(wall), 3);
}

TEST(PressedMotion, IsPushedByPressAndReaction) {
  PressedMotion moved = piston();
  // downwards 0.5 m (20 Pa - 4 Pa) - 3 N: 5 N on 4 kg for 0.1 s
  moved.push(1.0, 0.1, Vec(7, 3), 4, 0.5);
  EXPECT_DOUBLE_EQ(moved.speed, 0.125);
  EXPECT_DOUBLE_EQ(moved.mean_speed, 0.0625);
  const Kinematics later = moved.at(1.4)(0);
  EXPECT_TRUE(later.x.isApprox(Vec(1, 2 - 0.125 * 0.4)));
  EXPECT_TRUE(later.v.isApprox(Vec(0, -0.125)));
  EXPECT_TRUE(later.a.isApprox(Vec(0, -1.25)));
}

TEST(PressedMotion, IsHeldByItsStopsAndLetGo) {
  PressedMotion moved = piston();
  moved.speed = 1;
  EXPECT_DOUBLE_EQ(moved.way_at(0.5), 0.2);
  EXPECT_EQ(moved.speed_at(0.5), 0);
  moved.push(0.5, 0.1, Vec(0, 0), 0, 0.5);  // on against the stop
  EXPECT_DOUBLE_EQ(moved.way, 0.2);
  EXPECT_EQ(moved.speed, 0);
  moved.push(0.6, 0.1, Vec(0, 48), 0, 0.5);  // 8 N - 48 N
  EXPECT_DOUBLE_EQ(moved.speed, -1);
  EXPECT_DOUBLE_EQ(moved.way_at(0.7), 0.1);
  EXPECT_DOUBLE_EQ(moved.way_at(2), -0.1);
  EXPECT_EQ(moved.speed_at(2), 0);
}

TEST(PressedMotion, KnowsWhetherItIsPushedOnAgainstAStop) {
  PressedMotion moved = piston();
  moved.press.travel = Vec(0, 0.2);
  EXPECT_EQ(moved.steady_from(), 2);
  moved.push(0.5, 0.1, Vec(0, 48), 0, 0.5);  // 7.5 N - 48 N, back against where it starts
  EXPECT_EQ(moved.speed, 0);
  EXPECT_TRUE(moved.pushed_on);
  moved.push(0.6, 0.1, Vec(0, 0), 0, 0.5);
  EXPECT_FALSE(moved.pushed_on);
}

TEST(KeptPressure, IsTheMeanOfTheExtremesLessTheBackground) {
  const EquationOfState state{1000, 20, 7, 5};
  std::vector<Boundary> boundaries(3);
  boundaries[0].motion = piston();
  PressedMotion other = piston();
  other.press.pressure = {{0, 100}};
  boundaries[1].motion = other;
  EXPECT_EQ(kept_pressure({}, boundaries, state), 0) << "a free surface knows the whole";
  EXPECT_DOUBLE_EQ(kept_pressure(EnclosedMedium{}, boundaries, state), 0.5 * (10 + 100) - 5);
  std::get<PressedMotion>(boundaries[0].motion).time = 2;
  EXPECT_DOUBLE_EQ(kept_pressure(EnclosedMedium{}, boundaries, state), 0.5 * (30 + 100) - 5);
  EXPECT_DOUBLE_EQ(pressure_offset(EnclosedMedium{}, {}, boundaries, state), 0.5 * (30 + 100) - 5);
}

/// Water without weight in a closed tank under a piston from above, 0.5 wide.
Setting pressed_tank(double pressure) {
  Setting s = empty_space();
  s.parameters.artificial_viscosity = ArtificialViscosity{0.5, 0.0};
  s.scene.walls = {{"floor", {Vec(-0.15, -0.15), Vec(0.65, 0)}, {}},
                   {"left", {Vec(-0.15, 0), Vec(0, 1)}, {}},
                   {"right", {Vec(0.5, 0), Vec(0.65, 1)}, {}},
                   {"piston",
                    {Vec(0, 0.5), Vec(0.5, 0.65)},
                    {},
                    Press{.pressure = {{0, 0}, {0.1, pressure}},
                          .force = {},
                          .direction = Direction::minus_y,
                          .travel = Vec(-0.1, 0.1)}}};
  s.parameters.regions = {{"water", {Vec(0, 0), Vec(0.5, 0.5)}, Vec::Zero()}};
  s.parameters.wall_model.slip = WallSlip::free_slip;
  return s;
}

const Boundary& find(const WeaklyCompressible& solver, const std::string& name) {
  for (const auto& boundary : solver.boundaries())
    if (boundary.name == name) return boundary;
  throw std::out_of_range(name);
}

TEST(PressedTank, KeepsMomentumWithThePress) {
  WeaklyCompressible solver = pressed_tank(2000).solver();
  const auto& motion = std::get<PressedMotion>(find(solver, "piston").motion);
  double given = 0;  // by the press
  while (solver.time() < 0.2) {
    const double dt = solver.time_step_limit();
    given += dt * 0.5 * motion.press.pressure_at(solver.time() + 0.5 * dt, 0.5);
    solver.advance(dt);
  }
  const double by_walls = find(solver, "walls").impulse.total[1];
  EXPECT_NEAR(solver.momentum()[1] - motion.mass * motion.speed, by_walls - given, 1e-9 * given);
}

TEST(PressedTankRun, SwingsAboutThePressureOfThePress) {
  WeaklyCompressible solver = pressed_tank(2000).solver();
  const auto& motion = std::get<PressedMotion>(find(solver, "piston").motion);
  // By K = rho_0 c_0^2 = 400 kPa the water gives way by 0.5 m * 2000/400000 = 2.5 mm, a row more by the
  // wall's.
  double force = 0, way = 0, first = 0, last = 0;
  long samples = 0;
  for (int n = 0; n < 400; ++n) {
    run_until(solver, 0.2 + 0.005 * n);
    const double swing = std::abs(motion.way_at(solver.time()) - 0.003);
    (n < 100 ? first : last) = std::max(n < 100 ? first : n < 300 ? 0.0 : last, swing);
    force += find(solver, "piston").force_on_fluid.force()[1];
    way += motion.way_at(solver.time());
    ++samples;
  }
  EXPECT_NEAR(force / static_cast<double>(samples) / 0.5, -2000, 40);
  EXPECT_NEAR(way / static_cast<double>(samples), 0.003, 3e-4);
  EXPECT_LT(last, first) << "nothing feeds the swing";
}

TEST(PressedTank, TellsOfAPistonThatIsPushedAgainstTheStopAtWhichItStarts) {
  const auto told = [](const Vec& travel, double until) {
    Setting setting = pressed_tank(-2000);
    setting.scene.walls.back().press->travel = travel;
    WeaklyCompressible solver = setting.solver();
    const Said said;
    run_until(solver, until);
    solver.watch(solver.time());
    solver.watch(solver.time());
    return said.text();
  };
  EXPECT_EQ(told(Vec(0, 0.1), 0.05), "") << "its press still changes";
  const std::string words = told(Vec(0, 0.1), 0.11);
  const std::string what = "the wall 'piston' is pushed against the stop at which it starts, at t = 0.11";
  EXPECT_EQ(words.find(what), words.rfind(what)) << "once: " << words;
  EXPECT_NE(words.find(what), std::string::npos) << words;
  EXPECT_EQ(told(Vec(-0.1, 0.1), 0.11), "");
}

TEST(PressedTank, RefusesAPistonThatIsTooLightOrTooHeavy) {
  Setting setting = pressed_tank(2000);
  for (const double mass : {1.0, 1e20, 1e300}) {
    setting.scene.walls.back().press->mass = mass;
    EXPECT_THROW(setting.solver(), BadKey) << mass;
  }
}

}  // namespace
}  // namespace toryu::fluid
