// What is prescribed over time: clamps that move, loads and gravity that change.
#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"

namespace toryu::solid {
namespace {

Motion swinging(double amplitude, double frequency, double ramp) {
  return Motion{.sine = {{{{.amplitude = amplitude, .frequency = frequency, .ramp = ramp}, Vec(0, 1)}}}};
}

Parameters cantilever(const Motion& motion) {
  Parameters p = free_plate(4);
  p.clamps = {{.name = "root", .box = {Vec(-1, -1), Vec(0.015, 1)}, .motion = motion}};
  return p;
}

TEST(MovingClamp, TakesItsParticlesAlong) {
  Motion motion = swinging(1e-3, 20, 0.02);
  motion.rotation = Rotation{Vec(0, 0.01), {.angular_velocity = {{0, 0}, {1, 50}}}};
  const auto model = model_of(cantilever(motion));
  run_to(*model, 0.03);
  const Pose pose = motion.pose_at(0.03);
  for (std::uint32_t i = 0; i < model->particle_count(); ++i) {
    if (!model->body().held[i]) continue;
    const Vec& X = model->body().X[i];
    EXPECT_LT((X + model->displacement(i) - pose.place(X)).norm(), 1e-14);
    EXPECT_LT((model->velocity(i) - pose.velocity_of(X)).norm(), 1e-13);
  }
}

TEST(MovingClamp, GivesTheMomentumAndTheEnergyThatTheSolidGains) {
  Motion motion = swinging(1e-3, 20, 0.02);
  motion.rotation = Rotation{Vec(0, 0.01), {.angular_velocity = {{0, 0}, {0.1, 20}}}};
  Parameters p = cantilever(motion);
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -10);
  const auto model = model_of(p, scene);
  run_to(*model, 0.05);
  const Impulses& given = model->impulses();
  const Vec sum = given.loads + given.clamps;
  EXPECT_LT((Vec(observed(*model, "momentum_x"), observed(*model, "momentum_y")) - sum).norm(),
            1e-12 * given.loads.norm());
  const double work = observed(*model, "work_of_clamps");
  EXPECT_GT(work, 0.1);
  EXPECT_LT(std::abs(observed(*model, "dissipated_energy")), 1e-3 * work);
}

TEST(MovingClamp, AQuarterTurnOfABodyChangesNothingInIt) {
  // w r from the start, so that nothing swings; rho w^2 L^2/E = 3e-4
  const double omega = 10;
  Parameters p = cantilever(Motion{.rotation = Rotation{Vec(0, 0.01), {.angular_velocity = {{0, omega}}}}});
  p.initial_velocity = InitialVelocity{.profile = VelocityProfile::linear,
                                       .velocity = Vec(omega * 0.01, 0),
                                       .gradient = {{0.0, -omega}, {omega, 0.0}}};
  p.spacing = 0.01;
  p.clamps[0].box.max[0] = 0.02;
  const auto model = model_of(p);
  run_to(*model, M_PI / 2 / omega);
  for (std::uint32_t i = 0; i < model->particle_count(); ++i) {
    const Vec r = model->body().X[i] - Vec(0, 0.01);
    EXPECT_LT((model->body().X[i] + model->displacement(i) - Vec(0, 0.01) - Pose::across(r)).norm(),
              1e-3 * 0.08);
    EXPECT_LT(model->stress(i).von_mises(), 1e-3 * 2e6);
  }
}

TEST(MovingClamp, IsFeltAsGravityTheOtherWay) {
  const Motion motion = swinging(2e-3, 15, 0.02);
  const auto shaken = model_of(cantilever(motion));
  Scene scene = empty_scene();
  Rows rows;
  for (double t = 0; t < 0.06; t += 1e-5) rows.push_back({t, 0, -motion.mean_acceleration(t, 1e-6)[1]});
  scene.gravity_change = GravityChange{.acceleration = rows};
  Parameters still = cantilever(motion);
  still.clamps[0].motion.reset();
  const auto felt = model_of(still, scene);
  double largest = 0, difference = 0;
  run_to(*shaken, 0.05);
  run_to(*felt, 0.05);
  for (std::uint32_t i = 0; i < felt->particle_count(); ++i) {
    const Vec u = shaken->displacement(i) - motion.displacement_at(0.05);
    difference = std::max(difference, (u - felt->displacement(i)).norm());
    largest = std::max(largest, felt->displacement(i).norm());
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(difference, 1e-4 * largest);
  EXPECT_LT(std::abs(observed(*felt, "dissipated_energy")), 1e-3 * observed(*felt, "work_of_changes"));
}

TEST(ChangingLoad, GivesTheIntegralOfItsFactor) {
  Parameters p = free_plate(4);
  p.loads = {{.name = "pull",
              .box = {Vec(0, 0), Vec(0.08, 0.02)},
              .force = Vec(10, -5),
              .factor = {{0, 0}, {0.01, 2}},
              .sine = {{{.amplitude = 3, .frequency = 50}}}}};
  const auto model = model_of(p);
  run_to(*model, 0.01);
  const double integral = 0.01 + 3 * 2 / (100 * M_PI);  // half a period
  EXPECT_LT((model->impulses().loads - integral * Vec(10, -5)).norm(), 5e-5 * 10 * integral);
  const double m = model->total_mass(), v = 10 * integral / m;
  EXPECT_NEAR(observed(*model, "momentum_x"), m * v, 5e-5 * m * v);
  EXPECT_NEAR(observed(*model, "work_of_changes"), 0.5 * m * v * v * 1.25, 1e-4 * m * v * v);
}

TEST(WallContact, WallsTurn) {
  const Motion motion{.velocity = {{0, 1, 0}},
                      .rotation = Rotation{Vec(0.1, 0), {.angular_velocity = {{0, M_PI}}}}};
  const ContactWalls walls({{"ram", {Vec(0, 0), Vec(0.03, 0.02)}, motion}}, Contact{}, free_plate(4).material,
                           0.005, 0.0065);
  VecField solid;
  resize(solid, padded(1));
  auto at_start = walls.start(), later = walls.start();
  walls.prepare(at_start, solid, 1, 0);
  walls.prepare(later, solid, 1, 0.5);  // a quarter turn
  std::vector<Vec> X(walls.particle_count());
  for (std::size_t k = 0; k < X.size(); ++k) X[at_start.number[k]] = at(at_start.x, k);
  for (std::size_t k = 0; k < X.size(); ++k) {
    const Vec r = X[later.number[k]] - Vec(0.1, 0);
    EXPECT_LT((at(later.x, k) - Vec(0.6, 0) - Vec(-r[1], r[0])).norm(), 1e-14);
  }
}

TEST(MovingClamp, Refusals) {
  Parameters p = cantilever(swinging(1, 1, 1));
  EXPECT_TRUE(clamp_faults(p).empty());
  p.formulation = Formulation::updated_lagrangian;
  EXPECT_EQ(clamp_faults(p).at(0).second, "a clamp that moves needs formulation = \"total_lagrangian\"");
  p.formulation = Formulation::total_lagrangian;
  p.clamps.push_back({.name = "wheel",
                      .box = {Vec(0.07, -1), Vec(1, 1)},
                      .motion = Motion{.rotation = Rotation{Vec(0, 0), {.angular_velocity = {{0, 1}}}}}});
  EXPECT_EQ(clamp_faults(p).at(0).second,
            "where a clamp turns, all of a case move as one: this one does not move as 'wheel' does");
}

}  // namespace
}  // namespace toryu::solid
