// The volume of a medium that walls enclose.
#include "fluid_solver/held_volume.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace held_volume_test {

/// A small cavity whose lid slides, or, if `closing`, sinks at 1 m/s.
Setting cavity(bool closing = false) {
  Setting s = empty_space();
  s.parameters.kernel = KernelForm::wendland_c2;
  s.parameters.smoothing_ratio = 2;
  s.parameters.start_disorder = 0.2;
  s.parameters.artificial_viscosity.reset();
  s.parameters.laminar_viscosity = LaminarViscosity{10.0};
  s.parameters.particle_shifting = ParticleShifting{};
  s.scene.walls = {{"floor", {Vec(-0.25, -0.25), Vec(1.25, 0)}, {}},
                   {"left", {Vec(-0.25, 0), Vec(0, 1)}, {}},
                   {"right", {Vec(1, 0), Vec(1.25, 1)}, {}},
                   {"lid", {Vec(closing ? 0 : -0.25, 1), Vec(closing ? 1 : 1.25, 1.25)}, {}}};
  s.scene.walls.back().motion = Motion{.velocity = {{0, closing ? 0.0 : 1.0, closing ? -1.0 : 0.0}}};
  s.parameters.regions = {{"fluid", {Vec(0, 0), Vec(1, 1)}, Vec::Zero()}};
  return s;
}

TEST(HeldVolume, ScalesTheDensitiesAlike) {
  Particles fluid;
  fluid.count = 2;
  fluid.m = {2, 3}, fluid.rho = {4, 5};
  EXPECT_DOUBLE_EQ(volume(fluid), 1.1);
  hold_volume(fluid, 1.0);
  EXPECT_DOUBLE_EQ(fluid.rho[0], 4.4);
  EXPECT_DOUBLE_EQ(fluid.rho[1], 5.5);
  EXPECT_DOUBLE_EQ(volume(fluid), 1.0);
}

TEST(HeldVolumeRun, StaysWhileShiftingWouldMakeItCreep) {
  Setting s = cavity();
  auto floating = s.solver();
  s.parameters.held_volume = HeldVolume{};
  auto held = s.solver();
  run_until(floating, 0.3), run_until(held, 0.3);
  EXPECT_NEAR(columns(held)["mean_density"], 1000, 1e-9);
  EXPECT_GT(std::abs(columns(floating)["mean_density"] - 1000), 0.01);
  EXPECT_LT(largest_difference(positions(held), positions(floating)), 0.01) << "only the level changes";
}

TEST(HeldVolume, DoesNotHideThatAWallTakesRoom) {
  Setting s = cavity(true);
  s.parameters.held_volume = HeldVolume{};
  auto solver = s.solver();
  solver.advance(1e-9);
  EXPECT_NEAR(solver.density_of_packing(), 1000, 5);
  run_until(solver, 0.05);
  EXPECT_NEAR(columns(solver)["mean_density"], 1000, 1e-9);
  EXPECT_NEAR(solver.density_of_packing(), 1050, 15) << "the lid has sunk by a twentieth";
}

}  // namespace held_volume_test
}  // namespace toryu::fluid
