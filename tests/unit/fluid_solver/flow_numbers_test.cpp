/// Re, Ma and Wi of a case, against those worked by hand.
#include "fluid_solver/flow_numbers.hpp"

#include <gmock/gmock.h>

namespace toryu::fluid {
namespace {

using testing::ElementsAre;

/// 10 Pa s, 1000 kg/m3, 0.2 m wide and 1 m long.
Parameters oil() {
  Parameters p;
  p.density = 1000;
  p.sound_speed = 5;
  p.regions = {{"medium", {Vec(0, 0), Vec(1, 0.2)}, Vec::Zero()}};
  p.laminar_viscosity = LaminarViscosity{10};
  return p;
}

Scene with_piston(double speed) {
  Scene scene;
  scene.walls = {{"piston", {Vec(-0.1, 0), Vec(0, 0.2)}, Motion{{{0, 0, 0}, {1, speed, 0}}}}};
  return scene;
}

Scene under_gravity(double g, Geometry geometry = Geometry::plane) {
  Scene scene;
  scene.gravity = Vec(g, 0);
  scene.periodic = Periodic::x;
  scene.geometry = geometry;
  return scene;
}

TEST(FlowNumbers, AreThoseOfTheWalls) {
  const FlowNumbers n = flow_numbers(oil(), with_piston(0.5)).value();
  EXPECT_NEAR(n.reynolds, 10, 1e-9);  // 1000*0.5*0.2/10
  EXPECT_NEAR(n.mach, 0.1, 1e-12);
  EXPECT_TRUE(n.weissenberg.empty());
  EXPECT_EQ(text(n), "Re 10, Ma 0.1 at 0.5 m/s over the fluid's 0.2 m");
}

TEST(FlowNumbers, AreThoseOfTheFlowThatGravityDrives) {
  const FlowNumbers plane = flow_numbers(oil(), under_gravity(0.3)).value();
  EXPECT_NEAR(plane.speed, 0.1, 1e-6);  // rho g w^2/(12 eta)
  EXPECT_NEAR(plane.reynolds, 2, 1e-5);
  const FlowNumbers tube = flow_numbers(oil(), under_gravity(0.3, Geometry::axisymmetric)).value();
  EXPECT_NEAR(tube.speed, 0.15, 1e-6);  // rho g D^2/(32 eta), D = 0.4 m
}

TEST(FlowNumbers, CountAModeOfThePolymerEach) {
  Parameters p = oil();
  p.laminar_viscosity = LaminarViscosity{1};
  p.viscoelasticity = Viscoelasticity{{{2, 5, 0}, {0.1, 4, 0}}};
  const FlowNumbers n = flow_numbers(p, with_piston(0.5)).value();
  EXPECT_NEAR(n.reynolds, 10, 1e-9);  // of 1 + 5 + 4 Pa s
  EXPECT_THAT(n.weissenberg, ElementsAre(testing::DoubleNear(30, 1e-6), testing::DoubleNear(1.5, 1e-6)));
  EXPECT_EQ(text(n), "Re 10, Ma 0.1, Wi 30 and 1.5 at 0.5 m/s over the fluid's 0.2 m");
  p.viscoelasticity->modes[0].mobility = 0.3;  // thins: the wall is sheared faster
  EXPECT_GT(flow_numbers(p, with_piston(0.5))->weissenberg[0], 30.5);
}

TEST(FlowNumbers, AreNotMadeUp) {
  EXPECT_FALSE(flow_numbers(oil(), {}));  // nothing says how fast it flows
  EXPECT_FALSE(flow_numbers(oil(), under_gravity(0)));
  Parameters p = oil();
  p.laminar_viscosity.reset();
  EXPECT_FALSE(flow_numbers(p, with_piston(0.5)));
}

}  // namespace
}  // namespace toryu::fluid
