#include "fluid_solver/guards.hpp"

#include <gmock/gmock.h>

namespace toryu::fluid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Parameters water(double time_step_share, Integrator integrator) {
  Parameters p;
  p.sound_speed = 20;
  p.density_diffusion = DensityDiffusion{.delta = 0.1};
  p.time_step_share = time_step_share;
  p.integrator = integrator;
  return p;
}

TEST(FluidGuards, NameTheMapBeyondWhoseEdgeACaseLies) {
  EXPECT_THAT(beyond_edges(water(2.5, Integrator::midpoint), 1), ElementsAre());
  EXPECT_THAT(
      beyond_edges(water(2.7, Integrator::midpoint), 1),
      ElementsAre(HasSubstr("2.7 is beyond the edge of stability at 2.6; see cases/hydrostatic_tank")));
  EXPECT_THAT(beyond_edges(water(6.6, Integrator::symplectic), 1), ElementsAre());
  EXPECT_THAT(beyond_edges(water(6.8, Integrator::symplectic), 1), ElementsAre(HasSubstr("at 6.7")));
}

TEST(FluidGuards, KnowWhatDensityDiffusionBears) {
  Parameters p = water(2.0, Integrator::midpoint);
  p.density_diffusion->delta = 0.0125;  // an eighth: half the step
  EXPECT_DOUBLE_EQ(time_step_edge(p), 1.3);
  p.density_diffusion.reset();
  EXPECT_THAT(beyond_edges(p, 1), ElementsAre(HasSubstr("at 0.8")));
}

TEST(FluidGuards, WantTenTimesTheSpeed) {
  EXPECT_THAT(beyond_edges(water(1, Integrator::midpoint), 2.1),
              ElementsAre(HasSubstr("sound_speed 20 m/s is below")));
}

}  // namespace
}  // namespace toryu::fluid
