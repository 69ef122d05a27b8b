// Blocks that are strained uniformly, and a bar that turns.
#include "solid_case.hpp"

namespace toryu::solid {
namespace {

const std::vector<std::string> renormalised,
    plain = {"solid.gradients=plain"},
    neo_hookean = {"solid.formulation=total_lagrangian", "solid.law=neo_hookean", "solid.gradients=plain",
                   "solid.integrator=midpoint"};

/// Component of the stress [Pa] in the middle of the block after 20 microseconds.
double stress(const std::string& file, const std::vector<std::string>& form, const std::string& component) {
  const auto block = solid_case("patch_test/" + file, form);
  run_to(*block, 2e-5);
  return observed(*block, "middle_stress_" + component);
}

TEST(PatchTest, SmallStrainsGiveTheStressOfHookesLaw) {
  for (const auto& form : {renormalised, neo_hookean}) {
    EXPECT_NEAR(stress("uniaxial.toml", form, "xx") / 2381.0, 1, 2e-3);
    EXPECT_NEAR(stress("uniaxial.toml", form, "yy") / 2381.0, 0, 2e-3);
    EXPECT_NEAR(stress("isotropic.toml", form, "yy") / 7142.9, 1, 2e-3);
  }
  EXPECT_NEAR(stress("isotropic.toml", plain, "xx") / 7142.9, 1.009, 2e-3) << "sums of a lattice";
}

TEST(PatchTest, LargeShearIsASineUnderTheJaumannRateAndALineInRubber) {
  const double G = 2e6 / 2.8;
  EXPECT_NEAR(stress("case.toml", renormalised, "xy") / G, std::sin(1.0), 1e-4);
  EXPECT_NEAR(stress("case.toml", neo_hookean, "xy") / G, 1.0, 1e-4);
}

/// The case's bar after `turns`, the energy of motion over that of the start.
double energy_left(const std::vector<std::string>& form, double turns, double& largest_turn) {
  const auto bar = solid_case("rigid_rotation", form);
  const double start = observed(*bar, "kinetic_energy");
  run_to(*bar, turns * 0.05);
  for (const auto& [name, value] : bar->figures())
    if (name == "largest_bond_turn") largest_turn = value;
  return observed(*bar, "kinetic_energy") / start;
}

TEST(TurningBar, KeepsItsEnergyWithRenormalisedGradientsAndTearsItselfWithPlainOnes) {
  double turn = 0;
  EXPECT_NEAR(energy_left({}, 0.5, turn), 0.99, 0.01);
  EXPECT_GT(turn, 3.0) << "it looks at every fiftieth step";
  EXPECT_LT(energy_left(plain, 0.25, turn), 0.9);
}

}  // namespace
}  // namespace toryu::solid
