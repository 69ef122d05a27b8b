#include "solid_solver/updated_lagrangian/updated_lagrangian.hpp"

#include <gtest/gtest.h>

#include "common/error/failure.hpp"
#include "samples.hpp"

namespace toryu::solid {
namespace {

/// A block held on one side whose other particles start with the same velocity: all modes are struck.
Parameters struck_block(double courant_number) {
  Parameters p = free_plate(4);
  p.formulation = Formulation::updated_lagrangian;
  p.hourglass.reset();
  p.artificial_viscosity = ArtificialViscosity{};
  p.artificial_stress = ArtificialStress{};
  p.clamps = {{"bottom", {Vec(-1, -1), Vec(1, p.spacing)}}};
  p.initial_velocity = InitialVelocity{.velocity = Vec(0.003, 0.01)};
  p.courant_number = courant_number;
  p.time_step_share = 1.0;
  return p;
}

TEST(UpdatedLagrangianRun, ComesToRestWithTheLongestStepsThatMayBeAskedFor) {
  const auto model = model_of(struck_block(1.0));
  EXPECT_EQ(model->time_step_rule(), "acoustic");
  const double energy = observed(*model, "kinetic_energy");
  for (int n = 0; n < 4000; ++n) model->advance(model->time_step_limit());
  EXPECT_LT(observed(*model, "kinetic_energy"), 1e-9 * energy);
}

TEST(UpdatedLagrangian, AStateGoneWildIsNamedAndNotSearchedForNeighbours) {
  Parameters p = struck_block(1.0);
  p.artificial_viscosity.reset();
  const auto model = model_of(p);
  EXPECT_THROW(for (int n = 0; n < 4000; ++n) model->advance(model->time_step_limit()), PhysicsFailure);
}

}  // namespace
}  // namespace toryu::solid
