// cases/cylinder_in_channel: drag and lift against Schaefer & Turek (1996), test case 2D-1.
#include <gtest/gtest.h>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// What the cylinder has given the fluid since the start [N.s/m].
Vec impulse_of_cylinder(const FluidModel& solver) {
  for (const Boundary& boundary : solver.boundaries())
    if (boundary.name == "cylinder") return boundary.impulse.total;
  throw std::logic_error("cylinder");
}

TEST(CylinderInAChannel, HasTheDragOfTheBenchmark) {
  WeaklyCompressible solver = FluidCase("cylinder_in_channel").solver();
  run_until(solver, 3);
  const Vec before = impulse_of_cylinder(solver);
  run_until(solver, 5);
  const Vec force = (before - impulse_of_cylinder(solver)) / 2;
  const double to_coefficient = 2 / (1.0 * 0.2 * 0.2 * 0.1);  // 2/(rho U^2 D)
  RecordProperty("drag_coefficient", std::to_string(to_coefficient * force[0]));
  RecordProperty("lift_coefficient", std::to_string(to_coefficient * force[1]));
  EXPECT_NEAR(to_coefficient * force[0], 5.58, 0.02 * 5.58)
      << "+2.7 % by distances from the tangent and 0.3 Pa";
  EXPECT_LT(std::abs(to_coefficient * force[1] - 0.0107), 0.03)
      << "below what the disorder of particles does";
}

}  // namespace
}  // namespace toryu::fluid
