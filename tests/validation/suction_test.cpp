// A medium under suction: cases/retreating_piston.
#include <gtest/gtest.h>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// Pressure at the retreating piston over what a column of 1 m under 1 m/s2 takes off, at 0.2 s.
double suction(const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"fluid.spacing=0.05", "fluid.background_pressure.pressure=250"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  FluidSolver solver = FluidCase("retreating_piston", all).solver();
  run_until(solver, 0.2);
  for (const auto& seen : solver.observe())
    if (seen.name == "force_from_retreating_piston_x") return (250 + seen.value / 0.5) / 500;
  return 0;
}

TEST(RetreatingPiston, IsUnderTheSuctionOfTheColumn) {
  EXPECT_NEAR(suction({"fluid.particle_shifting={}"}), 1, 0.1);
}

TEST(RetreatingPiston, IsNotTornFromByTensileControl) {
  EXPECT_NEAR(suction({"fluid.particle_shifting={}", "fluid.tensile_control={}"}), 1, 0.1);
}

}  // namespace
}  // namespace toryu::fluid
