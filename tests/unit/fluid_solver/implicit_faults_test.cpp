// What the implicit model refuses, by name.
#include "fluid_solver/implicit/implicit_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace toryu::fluid {
namespace {

using testing::HasSubstr;

Parameters creeping() {
  Parameters p;
  p.artificial_viscosity.reset();
  p.density_diffusion.reset();
  p.model = Model::implicit;
  p.laminar_viscosity = LaminarViscosity{2000};
  return p;
}

std::string faults_of(const Parameters& p, bool with_solid = false, const Scene& scene = {}) {
  std::string all;
  for (const auto& [key, message] : implicit_faults(p, scene, with_solid)) all += key + ": " + message + "\n";
  return all;
}

TEST(ImplicitFaults, NameTheTerm) {
  Parameters p = creeping();
  EXPECT_EQ(faults_of(p), "");
  EXPECT_THAT(faults_of(p, true), HasSubstr("fluid.model: an elastic solid is not coupled to"));
  p.surface_tension = SurfaceTension{1};
  p.friction = Friction{};
  EXPECT_EQ(
      faults_of(p),
      "fluid.surface_tension: [fluid.surface_tension] is not part of model = \"implicit\"\n"
      "fluid.friction: [fluid.friction] without [fluid.wall_slip] is not part of model = \"implicit\"\n");
  p.model = Model::weakly_compressible;
  EXPECT_EQ(faults_of(p, true), "");
  Scene pressed;
  pressed.walls.resize(2);
  pressed.walls[1].name = "ram";
  pressed.walls[1].press.emplace();
  EXPECT_EQ(
      faults_of(creeping(), false, pressed),
      "fluid.implicit.expected_speed: the wall 'ram' is pressed, and the first steps must know how fast "
      "the medium will be: give the 'expected_speed' that is needed by model = \"implicit\"\n");
  Parameters foreseen = creeping();
  foreseen.implicit = ImplicitSolver{.expected_speed = 0.1};
  EXPECT_EQ(faults_of(foreseen, false, pressed), "");
  Parameters thin = creeping();
  thin.laminar_viscosity.reset();
  thin.wall_model.suction = false;
  thin.density_diffusion = DensityDiffusion{};
  EXPECT_THAT(faults_of(thin), HasSubstr("is needed by model"));
  EXPECT_THAT(faults_of(thin), HasSubstr("fluid.wall_model.suction: "));
  EXPECT_THAT(faults_of(thin), HasSubstr("fluid.density_diffusion: "));
}

}  // namespace
}  // namespace toryu::fluid
