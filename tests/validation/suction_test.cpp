// A medium under suction: cases/retreating_piston, rotating_square_patch.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// Pressure at the retreating piston over what a column of 1 m under 1 m/s2 takes off, at 0.2 s.
double suction(const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"fluid.spacing=0.05", "fluid.background_pressure.pressure=250"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  WeaklyCompressible solver = FluidCase("retreating_piston", all).solver();
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

TEST(RotatingSquarePatch, StaysWholeAndKeepsItsEnergy) {
  WeaklyCompressible solver = FluidCase("rotating_square_patch", {"fluid.spacing=0.04"}).solver();
  const auto seen = [&](const std::string& name) {
    for (const auto& observation : solver.observe())
      if (observation.name == name) return observation.value;
    return std::nan("");
  };
  EXPECT_NEAR(seen("pressure_in_the_middle") / -147.34, 1, 0.015) << "Poisson's equation";
  const double start = solver.kinetic_energy();
  double largest_void = 0;
  for (int n = 1; n <= 100; ++n) {
    run_until(solver, 0.02 * n);
    largest_void = std::max(largest_void, seen("largest_void"));
  }
  EXPECT_LT(largest_void, 1.1);
  // 0.959 and 0.984 at half and a quarter of the spacing.
  EXPECT_NEAR(solver.kinetic_energy() / start, 0.905, 0.01);
}

/// Past 0.6 s, by when shifts beside walls had raised the density by 15 % and ended the run.
TEST(AbrasiveFlow, ShiftingBesideWallsKeepsTheDensity) {
  WeaklyCompressible solver = FluidCase("abrasive_flow/rigid.toml", {"fluid.particle_shifting={}"}).solver();
  run_until(solver, 0.8);
  const Field& rho = solver.particles().rho;
  const auto end = rho.begin() + static_cast<std::ptrdiff_t>(solver.particle_count());
  EXPECT_LT(*std::max_element(rho.begin(), end), 1.02 * 1300);
  EXPECT_GT(*std::min_element(rho.begin(), end), 0.98 * 1300);
}

}  // namespace
}  // namespace toryu::fluid
