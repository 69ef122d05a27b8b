/// The solid against exact and finite-element solutions, seconds each.
#include "solid_plate.hpp"

namespace toryu {
namespace {

class OscillatingPlate : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Rows, OscillatingPlate, testing::Values(4, 5, 10));

TEST_P(OscillatingPlate, TotalLagrangianHasThePeriodAndKeepsTheAmplitude) {
  SolidParameters p = plate(GetParam());
  p.hourglass = HourglassPenalty{};
  const auto model = model_of(p);
  const Vibration vibration = vibrate(*model, 2);
  EXPECT_NEAR(vibration.period / plate_period, 1.0, 0.02);
  EXPECT_LT(std::abs(vibration.amplitude_loss), 0.01);
}

TEST(OscillatingPlate, UpdatedLagrangianOfFiveRowsIsTooSoft) {
  SolidParameters p = plate(5);
  p.formulation = Formulation::updated_lagrangian;
  p.artificial_viscosity = ArtificialViscosity{};
  p.artificial_stress = ArtificialStress{};
  const auto model = model_of(p);
  const Vibration vibration = vibrate(*model, 1);
  // Measured +19 %: that of a form without control of what its gradients do not see.
  EXPECT_NEAR(vibration.period / plate_period, 1.19, 0.02);
  EXPECT_LT(vibration.amplitude_loss, 0.10);
}

TEST(Cantilever, SagsUnderItsOwnWeightAsTimoshenkosBeam) {
  const double E = 2e6, nu = 0.4, L = 0.2, H = 0.02, rho = 1000, g = 0.05;
  SolidParameters p = plate(8);
  p.material = {.density = rho, .youngs_modulus = E, .poissons_ratio = nu};
  p.initial_velocity.reset();
  p.hourglass = HourglassPenalty{};
  p.damping = Damping{.rate = 25.0};
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -g);
  const auto model = model_of(p, scene);
  run_to(*model, 0.8);
  const double D = E * H * H * H / (12 * (1 - nu * nu)), G = E / (2 * (1 + nu)), q = rho * g * H;
  const double exact = q * std::pow(L, 4) / (8 * D) + q * L * L / (2 * (5.0 / 6.0) * G * H);
  const double tip = -observed(*model, "tip_displacement_y");
  std::printf("tip %.5g mm, exact %.5g mm (%+.2f %%)\n", 1e3 * tip, 1e3 * exact, 100 * (tip / exact - 1));
  EXPECT_NEAR(tip / exact, 1.0, 0.04);
  EXPECT_LT(observed(*model, "kinetic_energy"), 1e-8 * observed(*model, "elastic_energy")) << "it is at rest";
}

TEST(Cantilever, BendsUnderALoadAtItsEnd) {
  const double L = 0.2, H = 0.02, force = 0.05;
  SolidParameters p = plate(8);
  p.initial_velocity.reset();
  p.hourglass = HourglassPenalty{};
  p.damping = Damping{.rate = 25.0};
  p.loads = {{"end", {Vec(L - p.spacing, -1), Vec(1, 1)}, Vec(0, -force)}};
  const auto model = model_of(p);
  run_to(*model, 0.8);
  const double E = p.material.youngs_modulus, nu = p.material.poissons_ratio, G = p.material.shear_modulus();
  const double D = E * H * H * H / (12 * (1 - nu * nu)),
               reach = L - 0.5 * p.spacing;  // the force's lever arm
  // Deflection at the load, and from there to the tip along the tangent.
  const double exact = force * std::pow(reach, 3) / (3 * D) + force * reach / ((5.0 / 6.0) * G * H) +
                       force * reach * reach / (2 * D) * (L - reach);
  const double tip = -observed(*model, "tip_displacement_y");
  std::printf("tip %.5g mm, exact %.5g mm (%+.2f %%)\n", 1e3 * tip, 1e3 * exact, 100 * (tip / exact - 1));
  EXPECT_NEAR(tip / exact, 1.0, 0.04);
}

}  // namespace
}  // namespace toryu
