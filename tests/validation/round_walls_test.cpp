// Water at rest beside walls that are outlines: cases/tank_with_cylinder.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// m g H of a case: its water, 0.5 m deep [J/m].
double scale(const FluidModel& solver) {
  double mass = 0;
  for (std::size_t i = 0; i < solver.particles().count; ++i) mass += solver.particles().m[i];
  return mass * 9.81 * 0.5;
}

double kinetic_energy(const FluidModel& solver) {
  const auto& f = solver.particles();
  double sum = 0;
  for (std::size_t i = 0; i < f.count; ++i) sum += 0.5 * f.m[i] * at(f.v, i).squaredNorm();
  return sum;
}

TEST(TankWithCylinder, BearsTheWeightOfTheWaterInItsPlace) {
  const FluidCase tank("tank_with_cylinder/case.toml", {"fluid.spacing=0.02"});  // 10 across
  auto solver = tank.solver();
  const auto impulse = [&] {
    for (const Boundary& boundary : solver.boundaries())
      if (boundary.name == "cylinder") return boundary.impulse.total;
    return Vec(Vec::Zero());
  };
  run_until(solver, 0.25);
  const Vec before = impulse();
  run_until(solver, 0.5);
  const Vec force = (impulse() - before) / 0.25;
  const double weight = 1000 * 9.81 * std::numbers::pi * 0.01, rest = kinetic_energy(solver) / scale(solver);
  std::printf("force over Archimedes' %.4f, kinetic energy %.2g m g H\n", -force[1] / weight, rest);
  EXPECT_NEAR(-force[1] / weight, 1.0, 0.01);
  EXPECT_NEAR(force[0] / weight, 0.0, 0.01);
  EXPECT_LT(rest, 3e-5);
}

TEST(TankWithCylinder, WaterOverASlantedFloorStaysAtRest) {
  const FluidCase tank("tank_with_cylinder/slanted_floor.toml", {"fluid.spacing=0.0125"});
  auto solver = tank.solver();
  run_until(solver, 0.5);
  const double rest = kinetic_energy(solver) / scale(solver);
  std::printf("kinetic energy %.2g m g H\n", rest);
  EXPECT_LT(rest, 3e-5);
}

}  // namespace
}  // namespace toryu::fluid
