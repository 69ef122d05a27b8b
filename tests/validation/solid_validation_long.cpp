/// The updated Lagrangian solid at ten rows, as in the thesis: minutes.
#include "solid_plate.hpp"

namespace toryu::solid {
namespace {

Vibration updated_plate(Gradients gradients) {
  Parameters p = plate(10);
  p.formulation = Formulation::updated_lagrangian;
  p.gradients = gradients;
  p.artificial_viscosity = ArtificialViscosity{};  // A = B = 1
  p.artificial_stress = ArtificialStress{};        // epsilon = 0.3
  return vibrate(*model_of(p), 2);
}

TEST(OscillatingPlate, UpdatedLagrangianWithPlainGradients) {
  const Vibration vibration = updated_plate(Gradients::plain);
  EXPECT_NEAR(vibration.period / plate_period, 1.0, 0.21);
  EXPECT_LT(vibration.amplitude_loss, 0.03);
}

TEST(OscillatingPlate, UpdatedLagrangianWithRenormalisedGradients) {
  const Vibration vibration = updated_plate(Gradients::renormalised);
  EXPECT_NEAR(vibration.period / plate_period, 1.0, 0.11);
  EXPECT_LT(vibration.amplitude_loss, 0.02);
}

}  // namespace
}  // namespace toryu::solid
