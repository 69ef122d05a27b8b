// The fluid's momentum is what the boundaries and gravity have given it.
#include <gtest/gtest.h>

#include <map>

#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

/// Water between a piston that pushes, a wall, and a floor that rubs.
Setting pushed_water() {
  Setting setting = collapsing_column();
  setting.scene.walls[0].work_piece = true;
  setting.scene.walls[1].motion = Motion{{{0.0, 0.0, 0.0}, {0.1, 0.8, 0.0}, {0.2, -0.5, 0.1}}};
  setting.parameters.regions.front().box.max = Vec(1.0, 0.4);
  setting.parameters.regions.front().velocity = Vec(0.3, 0.0);
  setting.parameters.hydrostatic_start = HydrostaticStart{0.4};
  setting.parameters.laminar_viscosity = LaminarViscosity{3.0};
  setting.parameters.friction = Friction{.coefficient = 0.4};
  return setting;
}

/// Vectors of the series by name, without _x and _y.
std::map<std::string, Vec> vectors(const WeaklyCompressible& solver) {
  std::map<std::string, Vec> found;
  for (const auto& seen : solver.observe()) {
    const std::string name = seen.name.substr(0, seen.name.size() - 2), end = seen.name.substr(name.size());
    if (end == "_x") found[name][0] = seen.value;
    if (end == "_y") found[name][1] = seen.value;
  }
  return found;
}

class Impulses : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Impulses,
                         testing::Values(Integrator::midpoint, Integrator::symplectic));

TEST_P(Impulses, SumToTheChangeOfMomentum) {
  Setting setting = pushed_water();
  setting.parameters.integrator = GetParam();
  WeaklyCompressible solver = setting.solver();
  const Vec start = vectors(solver)["momentum"];
  EXPECT_GT(start[0], 0);
  for (const double time : {0.01, 0.12}) {
    run_until(solver, time);
    auto seen = vectors(solver);
    Vec sum = Vec::Zero();
    double size = 0;
    for (const auto& name :
         {"impulse_from_floor", "impulse_from_left", "impulse_from_walls", "impulse_of_gravity"}) {
      EXPECT_GT(seen.at(name).norm(), 0) << name;
      sum += seen.at(name);
      size += seen.at(name).norm();
    }
    EXPECT_LT((seen["momentum"] - start - sum).norm(), 1e-12 * size) << time;
  }
}

TEST(FrictionImpulse, IsToldApart) {
  Setting setting = pushed_water();
  setting.parameters.laminar_viscosity.reset();
  setting.parameters.wall_model.slip = WallSlip::free_slip;
  WeaklyCompressible solver = setting.solver();
  run_until(solver, 0.1);
  const auto seen = vectors(solver);
  EXPECT_LT(seen.at("friction_impulse_from_floor")[0], 0);
  // along a plane floor with free slip there is little else
  const double along = seen.at("impulse_from_floor")[0];
  EXPECT_NEAR(along, seen.at("friction_impulse_from_floor")[0], 0.15 * std::abs(along));
  EXPECT_GT(seen.at("impulse_from_floor")[1], 5 * std::abs(seen.at("friction_impulse_from_floor")[1]));
  EXPECT_EQ(seen.count("friction_impulse_from_left"), 0u);
}

TEST(OtherImpulses, AreTheForcesOverTheSteps) {
  WeaklyCompressible solver = pushed_water().solver();
  Vec total = Vec::Zero(), friction = Vec::Zero();
  for (int n = 0; n < 20; ++n) {
    const double dt = solver.time_step_limit();
    solver.advance(dt);
    const auto seen = vectors(solver);
    total += dt * seen.at("force_from_floor");
    friction += dt * seen.at("friction_from_floor");
  }
  const auto seen = vectors(solver);
  EXPECT_LT((seen.at("impulse_from_floor") - total).norm(), 1e-14 * total.norm());
  EXPECT_LT((seen.at("friction_impulse_from_floor") - friction).norm(), 1e-14 * friction.norm());
}

}  // namespace
}  // namespace toryu::fluid
