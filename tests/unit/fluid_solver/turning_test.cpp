// Walls that turn, and gravity that changes.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

/// A paddle that turns in a square of fluid in empty space, by central forces alone.
Setting stirred_square(Integrator integrator) {
  Setting s = empty_space();
  s.parameters.integrator = integrator;
  s.parameters.regions = {{"square", {Vec(-0.5, -0.5), Vec(0.5, 0.5)}, Vec::Zero()}};
  s.parameters.holes = {{{Vec(-0.3, -0.05), Vec(0.3, 0.05)}, ""}};
  s.scene.walls = {{"paddle", {Vec(-0.3, -0.05), Vec(0.3, 0.05)}, {}}};
  s.scene.walls[0].motion =
      Motion{.velocity = {{0, 0, 0}, {0.1, 0.3, 0}},
             .rotation = Rotation{Vec(-0.1, 0), {.angular_velocity = {{0, 0}, {0.1, 4}}}}};
  return s;
}

TEST(TurningWall, ItsParticlesTurn) {
  Setting s = stirred_square(Integrator::symplectic);
  s.scene.walls[0].motion = turning_at(3, Vec(-0.1, 0));
  WeaklyCompressible solver = s.solver();
  const Boundary& start = solver.boundaries()[0];
  std::vector<Vec> X(start.count);
  for (std::size_t k = 0; k < start.count; ++k) X[start.id[k]] = at(start.x, k);
  run_until(solver, 0.1);
  const Boundary& paddle = solver.boundaries()[0];
  for (std::size_t k = 0; k < paddle.count; ++k) {
    const Vec r = X[paddle.id[k]] - Vec(-0.1, 0);
    const Vec turned(std::cos(0.3) * r[0] - std::sin(0.3) * r[1],
                     std::sin(0.3) * r[0] + std::cos(0.3) * r[1]);
    EXPECT_LT((at(paddle.x, k) - Vec(-0.1, 0) - turned).norm(), 1e-14);
    EXPECT_LT((at(paddle.v, k) - 3 * Vec(-turned[1], turned[0])).norm(), 1e-13);
    EXPECT_LT((at(paddle.acceleration, k) + 9 * turned).norm(), 1e-12);
  }
}

double angular_momentum(const WeaklyCompressible& solver, const Vec& about) {
  const Particles& f = solver.particles();
  double sum = 0;
  for (std::size_t i = 0; i < f.count; ++i) {
    const Vec r = at(f.x, i) - about;
    sum += f.m[i] * (r[0] * f.v[1][i] - r[1] * f.v[0][i]);
  }
  return sum;
}

class StirredSquare : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, StirredSquare,
                         testing::Values(Integrator::midpoint, Integrator::symplectic));

TEST_P(StirredSquare, GainsTheAngularMomentumAndTheEnergyThatThePaddleGives) {
  Setting s = stirred_square(GetParam());
  WeaklyCompressible solver = s.solver();
  run_until(solver, 0.08);
  double worst = 0, largest = 0, work = columns(solver).at("work_from_paddle");
  for (int step = 0; step < 20; ++step) {
    const double dt = solver.time_step_limit(), t = solver.time() + 0.5 * dt;
    const Vec pivot = s.scene.walls[0].motion->pose_at(t).centre;
    const double before = angular_momentum(solver, pivot);
    solver.advance(dt);
    const auto row = columns(solver);
    worst = std::max(worst,
                     std::abs(angular_momentum(solver, pivot) - before - dt * row.at("moment_from_paddle")));
    largest = std::max(largest, std::abs(dt * row.at("moment_from_paddle")));
    const Pose pose = s.scene.walls[0].motion->pose_at(t);
    const double power = row.at("force_from_paddle_x") * pose.velocity[0] +
                         row.at("force_from_paddle_y") * pose.velocity[1] +
                         row.at("moment_from_paddle") * pose.angular_velocity;
    EXPECT_NEAR(row.at("power_from_paddle"), power, 1e-12 * std::abs(power));
    EXPECT_NEAR(row.at("work_from_paddle") - work, dt * power, 1e-12 * std::abs(work));
    work = row.at("work_from_paddle");
  }
  EXPECT_GT(largest, 1e-3);
  // The midpoint step drifts by a velocity that the forces of its middle have not made alone.
  EXPECT_LT(worst, (GetParam() == Integrator::symplectic ? 1e-12 : 1e-3) * largest);
}

TEST(TurningWallRun, TheEnergyBalanceClosesAsForOneThatShifts) {
  Setting s = stirred_square(Integrator::symplectic);
  WeaklyCompressible solver = s.solver();
  while (solver.time() < 0.15) {
    solver.advance(0.2 * solver.time_step_limit());
    solver.record(solver.time());
  }
  const auto row = columns(solver);
  EXPECT_GT(row.at("work_from_paddle"), 1);
  EXPECT_LT(std::abs(row.at("energy_remainder")), 0.03 * row.at("work_from_paddle"));
}

TEST(TurningWallRun, WhatThickFluidTakesIsDissipated) {
  Setting s = stirred_square(Integrator::symplectic);
  s.parameters.laminar_viscosity = LaminarViscosity{50};
  WeaklyCompressible solver = s.solver();
  while (solver.time() < 0.15) {
    solver.advance(0.2 * solver.time_step_limit());
    solver.record(solver.time());
  }
  const auto row = columns(solver);
  EXPECT_GT(row.at("dissipated_by_viscosity"), 0.5 * row.at("work_from_paddle"));
  EXPECT_LT(std::abs(row.at("energy_remainder")), 1e-3 * row.at("work_from_paddle"));
}

TEST(TurningWall, LimitsTheStepByTheSpeedOfItsTip) {
  Setting s = stirred_square(Integrator::symplectic);
  s.parameters.artificial_viscosity.reset();
  s.scene.walls[0].motion.reset();
  const double at_rest = s.solver().time_step_limit();
  s.scene.walls[0].motion = turning_at(20, Vec(0, 0));
  const double tip = 20 * (Vec(0.3, 0.05) - Vec(0.025, 0.025)).norm();
  EXPECT_NEAR(s.solver().time_step_limit(), at_rest * 20 / (20 + tip), 1e-9 * at_rest);
}

/// A column that collapses in a tank which is shaken: by its walls, or by gravity as the tank feels it.
Setting shaken_column(bool by_gravity) {
  Setting s = collapsing_column();
  s.parameters.regions.front().box.max = Vec(1, 0.4);
  s.parameters.hydrostatic_start = HydrostaticStart{0.4};
  Motion motion{.sine = {{{{.amplitude = 0.01, .frequency = 2, .ramp = 0.5}, Vec(1, 0)}}}};
  if (!by_gravity) {
    s.scene.motions = {{"tank", motion}};
    for (Wall& wall : s.scene.walls) wall.motion = motion, wall.moves_with = "tank";
    return s;
  }
  Rows rows;  // - a(t) of the tank
  for (double t = 0; t < 1; t += 1e-3) rows.push_back({t, -motion.mean_acceleration(t, 1e-5)[0], 0});
  s.scene.gravity_change = GravityChange{.acceleration = rows};
  return s;
}

TEST(GravityChange, IsWhatAShakenTankFeels) {
  WeaklyCompressible by_walls = shaken_column(false).solver(), by_gravity = shaken_column(true).solver();
  run_until(by_walls, 0.4);
  run_until(by_gravity, 0.4);
  const double shift = shaken_column(false).scene.motions[0].motion.displacement_at(0.4)[0];
  const auto moved = positions(by_walls), felt = positions(by_gravity);
  const auto still = positions(shaken_column(true).solver());
  double difference = 0, change = 0;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    difference += std::abs(moved[k][0] - shift - felt[k][0]);
    change += std::abs(felt[k][0] - still[k][0]);
  }
  EXPECT_LT(difference, 0.03 * change);
}

TEST(GravityChange, GivesAnImpulseAndDoesWork) {
  Setting s = shaken_column(true);
  s.parameters.artificial_viscosity.reset();
  s.parameters.density_diffusion.reset();
  s.scene.walls.clear();
  s.scene.gravity = Vec(0, -5);
  s.scene.gravity_change = GravityChange{.acceleration = {{0, 0, 0}, {1, 10, 0}}};
  s.parameters.hydrostatic_start.reset();
  WeaklyCompressible solver = s.solver();
  while (solver.time() < 0.2 - 1e-12) solver.advance(std::min(1e-3, 0.2 - solver.time()));
  const auto row = columns(solver);
  const double m = 1000 * 0.4;  // falls freely: v_x = 5 t^2, v_y = -5 t
  EXPECT_NEAR(row.at("impulse_of_gravity_x"), m * 5 * 0.04, 1e-9);
  EXPECT_NEAR(row.at("impulse_of_gravity_y"), -m, 1e-9);
  EXPECT_NEAR(row.at("work_of_gravity_change"), 0.5 * m * 0.04, 1e-9);
  EXPECT_NEAR(row.at("dissipated_energy"), 0, 1e-9);
  EXPECT_NEAR(row.at("gravity_x"), 2, 1e-14);
}

}  // namespace
}  // namespace toryu::fluid
