#include "fluid_solver/stability_warnings.hpp"

#include <gmock/gmock.h>

#include "fluid_solver/wall_rows.hpp"

namespace toryu::fluid {
namespace {

using testing::Contains;
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
  EXPECT_THAT(stability_warnings(water(2.5, Integrator::midpoint), {1}), ElementsAre());
  EXPECT_THAT(
      stability_warnings(water(2.7, Integrator::midpoint), {1}),
      ElementsAre(HasSubstr("2.7 is beyond the edge of stability at 2.6; see cases/hydrostatic_tank")));
  EXPECT_THAT(stability_warnings(water(6.6, Integrator::symplectic), {1}), ElementsAre());
  EXPECT_THAT(stability_warnings(water(6.8, Integrator::symplectic), {1}), ElementsAre(HasSubstr("at 6.7")));
}

TEST(FluidGuards, KnowNoEdgeOfImplicitSteps) {
  Parameters p = water(10, Integrator::midpoint);
  p.model = Model::implicit;
  EXPECT_THAT(stability_warnings(p, {1}), ElementsAre());
}

TEST(FluidGuards, WarnOfRingsThatAPassageDrawsTooFarApart) {
  Parameters p;
  p.regions = {{"medium", {Vec(0, 0), Vec(0.02, 0.003)}, Vec::Zero()}};
  p.similarity = Similarity{.passage_width = 0.002};
  p.smoothing_ratio = 2;
  Scene scene;
  EXPECT_FALSE(beyond_thinnest_rings(p, scene)) << "in the plane nothing is drawn apart";
  scene.geometry = Geometry::axisymmetric;  // from 6 to 2 mm: sqrt(3) = 1.73
  const auto said = beyond_thinnest_rings(p, scene);
  EXPECT_THAT(said,
              testing::Optional(HasSubstr("stand 1.7 times as far apart: the kernel has h/d0 1.2 there")));
  EXPECT_THAT(said, testing::Optional(HasSubstr("take smoothing_ratio = 3,")));
  p.smoothing_ratio = 3;
  EXPECT_FALSE(beyond_thinnest_rings(p, scene));
  p.smoothing_ratio = 2;
  p.similarity->passage_width = 0.006;  // a tube
  EXPECT_FALSE(beyond_thinnest_rings(p, scene));
}

TEST(FluidGuards, KnowWhatDensityDiffusionBears) {
  Parameters p = water(2.0, Integrator::midpoint);
  p.density_diffusion->delta = 0.0125;  // an eighth: half the step
  EXPECT_DOUBLE_EQ(time_step_edge(p), 1.3);
  p.density_diffusion.reset();
  EXPECT_DOUBLE_EQ(time_step_edge(p), 0.8);
  EXPECT_THAT(stability_warnings(p, {1}), Contains(HasSubstr("at 0.8")));
}

TEST(FluidGuards, BearABareSectionAndNameOneThatNothingDamps) {
  Parameters p;
  p.density_diffusion = DensityDiffusion{};  // as of a case that does not mention it
  p.sound_speed = 20;
  EXPECT_THAT(stability_warnings(p, {1}), ElementsAre());
  p.density_diffusion.reset();
  EXPECT_THAT(stability_warnings(p, {1}), ElementsAre(HasSubstr("neither [fluid.density_diffusion] nor")));
  p.artificial_viscosity = ArtificialViscosity{};
  EXPECT_THAT(stability_warnings(p, {1}), ElementsAre());
}

TEST(FluidGuards, WantWorkPiecesAsFineAsTheFluid) {
  Parameters p = water(1, Integrator::midpoint);
  p.spacing = 0.5e-3;
  EXPECT_FALSE(beyond_coarsest_work_piece(1e-3, p)) << "nothing rubs";
  p.friction = Friction{.coefficient = 0.3};
  EXPECT_FALSE(beyond_coarsest_work_piece(0.5e-3, p));
  EXPECT_THAT(beyond_coarsest_work_piece(1e-3, p), testing::Optional(HasSubstr("stand 0.001 m apart")));
}

TEST(FluidGuards, WantSlipOrAGrainLengthOfWhatComesOff) {
  Parameters p;
  EXPECT_FALSE(removal_by_grain_length(p));
  p.removal = Removal{.preston_coefficient = 1e-9, .archard = {}, .roughness = {}};
  EXPECT_THAT(removal_by_grain_length(p).value_or(""),
              testing::HasSubstr("in proportion to 'grain_length', which is 0.0001 m"));
  p.wall_slip = SlipLaw{1e-7};
  EXPECT_FALSE(removal_by_grain_length(p));
  p.wall_slip.reset();
  p.wall_model.slip = WallSlip::free_slip;
  EXPECT_FALSE(removal_by_grain_length(p));
}

TEST(FluidGuards, WantTenTimesTheSpeed) {
  EXPECT_THAT(stability_warnings(water(1, Integrator::midpoint), {2.1}),
              ElementsAre(HasSubstr("sound_speed 20 m/s is below")));
}

TEST(FluidGuards, KnowWhatIsTooThinToPartWater) {
  Parameters p = water(1, Integrator::midpoint);
  p.spacing = 0.01;
  p.smoothing_ratio = 1.5;
  EXPECT_DOUBLE_EQ(thinnest_wall(p), 0.02);
  const auto wall = [&](int columns, int rows, double spacing) {
    std::vector<Vec> places;
    for (int c = 0; c < columns; ++c)
      for (int r = 0; r < rows; ++r) places.push_back(spacing * Vec(c + 0.5, r + 0.5));
    Boundary boundary;
    boundary.name = "leaf";
    boundary.place(places, std::vector<double>(places.size(), spacing * spacing), 1000, 0.03);
    return beyond_thinnest(boundary, spacing, p);
  };
  EXPECT_FALSE(wall(2, 20, 0.01));
  EXPECT_FALSE(wall(20, 4, 0.005));
  EXPECT_THAT(*wall(1, 20, 0.01), HasSubstr("'leaf' is 0.01 m thick in places, a single row of particles, "
                                            "through which fluid leaks, and below 2h - d0 = 0.02 m"));
  EXPECT_THAT(*wall(20, 3, 0.005), HasSubstr("is 0.015 m thick in places, and below"));
  EXPECT_FALSE(wall(1, 15, 0.01)) << "as few as the poles of a round body";
}

TEST(FluidGuards, KnowWhatIsTooNarrowForAJet) {
  const auto said = [](int columns, int rows, const std::vector<Boundary>& walls) {
    Particles fluid;
    fluid.count = static_cast<std::size_t>(columns * rows);
    resize(fluid.x, fluid.count);
    for (int n = 0; n < columns * rows; ++n)
      set(fluid.x, static_cast<std::size_t>(n), 0.01 * Vec(n % columns + 0.5, n / columns + 0.5));
    return beyond_thinnest_jet(fluid, walls, 0.01);
  };
  EXPECT_FALSE(said(3, 20, {}));
  EXPECT_THAT(*said(2, 20, {}), HasSubstr("the fluid is 2 particles wide in places"));
  EXPECT_THAT(*said(20, 1, {}), HasSubstr("is 1 particle wide"));
  EXPECT_FALSE(said(15, 1, {})) << "a drop";
  Boundary floor;
  std::vector<Vec> places;
  for (int n = 0; n < 20; ++n) places.push_back(0.01 * Vec(n + 0.5, -0.5));
  floor.place(places, std::vector<double>(places.size(), 1e-4), 1000, 0.03);
  EXPECT_TRUE(said(20, 1, {floor}));
  EXPECT_FALSE(said(20, 2, {floor})) << "a film on a floor";
}

TEST(FluidGuards, WantNoWallToStartAtOnceFasterThanAShareOfSound) {
  EXPECT_THAT(stability_warnings(water(1, Integrator::midpoint), {0, {1.4, "piston", 0}}), ElementsAre());
  EXPECT_THAT(
      stability_warnings(water(1, Integrator::midpoint), {0, {1.6, "piston", 0.5}}),
      ElementsAre(HasSubstr(
          "wall 'piston' changes its speed at once by 1.6 m/s at t = 0.5 s, 0.08 of the sound speed")));
}

TEST(FluidGuards, WantRowsOfAWallToEndAtTheFluid) {
  Parameters p;
  p.spacing = 0.1;
  p.regions = {{"water", {Vec(0, 0), Vec(2, 1)}}};
  const auto said = [&](const Box& box) { return misplaced_faces({{"wall", box, {}}}, p); };
  EXPECT_THAT(said({Vec(-0.4, -0.4), Vec(2.4, 0)}), ElementsAre());
  EXPECT_THAT(said({Vec(0, -0.658), Vec(2, 0)}), ElementsAre()) << "7 rows fit";
  EXPECT_THAT(said({Vec(-0.34, 0), Vec(0, 1)}),
              ElementsAre(HasSubstr("'wall' is 3.4 spacings long along x: its last row stands 0.57 spacings "
                                    "from its face, not 0.5, and fluid may sink in or leave a gap; take 0.3 "
                                    "or 0.4 m")));
  EXPECT_THAT(said({Vec(2, 0), Vec(2.34, 1)}), ElementsAre()) << "rows begin at the fluid";
  EXPECT_THAT(said({Vec(-0.4, -0.34), Vec(2.4, -0.2)}), ElementsAre()) << "the fluid stands elsewhere";
  EXPECT_THAT(said({Vec(3, -0.34), Vec(4, 0)}), ElementsAre()) << "beside it";
}

TEST(FluidGuards, TakeOfAWallWhatMovesAcrossIt) {
  Parameters p = water(1, Integrator::midpoint);
  p.spacing = 0.01;
  Scene scene;
  scene.end_time = 1;
  scene.walls = {{"lid", {Vec(0, 0), Vec(5, 1)}, Motion{.velocity = {{0, 3, -2}}}}};
  EXPECT_DOUBLE_EQ(hardest_blow(scene, p).speed, 2);
  p.regions = {{"water", {Vec(0, -1), Vec(5, 0)}, Vec(3, -2)}};
  EXPECT_DOUBLE_EQ(hardest_blow(scene, p).speed, 0) << "it moves with the fluid";
  scene.walls[0].motion.reset();
  EXPECT_DOUBLE_EQ(hardest_blow(scene, p).speed, 0);
}

TEST(FluidGuards, FindAJumpInTheMiddleOfAPrescribedMotion) {
  Parameters p = water(1, Integrator::midpoint);
  p.spacing = 0.01;  // sound crosses the kernel in 1.3 ms
  Scene scene;
  scene.end_time = 1;
  const auto blow = [&](const std::vector<std::vector<double>>& velocity) {
    scene.walls = {{"ram", {Vec(0, 0), Vec(1, 5)}, Motion{.velocity = velocity}}};
    return hardest_blow(scene, p);
  };
  const Blow stop = blow({{0, 0, 0}, {0.1, 2, 0}, {0.5, 2, 0}, {0.50000001, 0, 0}});
  EXPECT_NEAR(stop.speed, 2, 1e-12);
  EXPECT_NEAR(stop.time, 0.5, 2e-3);
  EXPECT_EQ(stop.wall, "ram");
  EXPECT_LT(blow({{0, 0, 0}, {0.1, 2, 0}, {0.5, 2, 0}, {0.6, 0, 0}}).speed, 0.03);
  EXPECT_LT(blow({{0, 0, 0}, {0.1, 0, 2}, {0.10000001, 0, 0}}).speed, 1e-12) << "it slides";
  EXPECT_LT(blow({{0, 0, 0}, {2, 0, 0}, {2.00000001, 5, 0}}).speed, 1e-12) << "after the end";
}

TEST(FluidGuards, WantSoundFasterThanDeepWaterFalls) {
  Parameters p = water(1, Integrator::midpoint);
  p.regions = {{"water", {Vec(0, 0), Vec(5, 1)}}};
  const Start start{.gravity = Vec(0, -9)};  // sqrt(g H) = 3 m/s
  EXPECT_THAT(stability_warnings(p, start), ElementsAre(HasSubstr("below the edge of 20.7 m/s")));
  EXPECT_THAT(stability_warnings(p, {.gravity = Vec(1, -4)}),
              ElementsAre(HasSubstr("below the edge of 20.7 m/s")))
      << "from corner to corner";
  p.hydrostatic_start = HydrostaticStart{1};
  EXPECT_THAT(stability_warnings(p, start), ElementsAre());
  p.sound_speed = 6;
  EXPECT_THAT(stability_warnings(p, start),
              ElementsAre(HasSubstr("below the edge of 6.3 m/s for fluid that deep;")));
}

TEST(FluidGuards, KnowThatAlongAPeriodGravityMakesNoDepth) {
  Scene scene;
  scene.gravity = Vec(3, -4);
  EXPECT_EQ(gravity_on_columns(scene), Vec(3, -4));
  scene.periodic = Periodic::x;
  EXPECT_EQ(gravity_on_columns(scene), Vec(0, -4));
  scene.periodic = Periodic::xy;
  EXPECT_EQ(gravity_on_columns(scene), Vec(0, 0));
}

}  // namespace
}  // namespace toryu::fluid
