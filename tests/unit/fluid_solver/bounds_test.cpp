// Values that leave physics are named with particle, time, value and limit; bodies that overlap are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

Setting one_block(const Vec& velocity = Vec::Zero()) {
  Setting setting = empty_space();
  setting.parameters.regions = {{"block", {Vec(0, 0), Vec(0.2, 0.2)}, velocity}};
  setting.scene.gravity = Vec(0, -10);
  return setting;
}

std::string failure(const WeaklyCompressible& solver) {
  try {
    solver.check(solver.time());
  } catch (const PhysicsFailure& error) {
    return error.what();
  }
  return "none";
}

TEST(Bounds, LetPhysicsPass) {
  EXPECT_EQ(failure(one_block(Vec(19, 0)).solver()), "none");
}

TEST(Bounds, NameAParticleThatIsTooFast) {
  EXPECT_EQ(failure(one_block(Vec(15, -20)).solver()),
            "fluid particle 0 at t = 0 s: speed [m/s] = 25, limit 20");
  Setting setting = one_block(Vec(3, 0));
  setting.parameters.limits.largest_speed = 2.5;
  EXPECT_EQ(failure(setting.solver()), "fluid particle 0 at t = 0 s: speed [m/s] = 3, limit 2.5");
}

TEST(Bounds, NameTheParticleOfSeveral) {
  Setting setting = one_block();
  setting.parameters.regions.push_back({"fast", {Vec(1, 1), Vec(1.1, 1.1)}, Vec(0, 30)});
  EXPECT_EQ(failure(setting.solver()), "fluid particle 16 at t = 0 s: speed [m/s] = 30, limit 20");
}

TEST(Bounds, NameAParticleThatIsTooDense) {
  Setting setting = one_block();
  setting.parameters.limits.largest_density_change = 0.01;
  setting.parameters.hydrostatic_start = HydrostaticStart{1.0};
  EXPECT_THAT(
      failure(setting.solver()),
      testing::MatchesRegex("fluid particle 0 at t = 0 s: density .kg/m3. = 1023.01, limit 990 to 1010"));
}

TEST(Bounds, NameAParticleThatIsNoNumber) {
  Setting setting = one_block();
  setting.parameters.hydrostatic_start = HydrostaticStart{-100.0};  // no density is as low as that
  EXPECT_THAT(failure(setting.solver()),
              testing::MatchesRegex(
                  "fluid particle 0 at t = 0 s: density .kg/m3. = not a number, limit 700 to 1300"));
}

TEST(Bounds, NameAParticleThatLeavesTheDomain) {
  Setting setting = one_block(Vec(4, 0));
  // One row: of a column, the order of the particles would choose which is named.
  setting.parameters.regions.front().box.max[1] = 0.05;
  setting.scene.gravity = Vec::Zero();
  setting.scene.domain.max = Vec(0.35, 10);
  WeaklyCompressible solver = setting.solver();
  run_until(solver, 0.03);
  EXPECT_EQ(failure(solver), "none");
  run_until(solver, 0.05);
  EXPECT_EQ(
      failure(solver),
      "fluid particle 3 at t = 0.05 s: position (0.375, 0.025) [m], outside by = 0.025, limit the domain of "
      "the case");
}

std::string refusal(const Setting& setting) {
  try {
    setting.solver();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "none";
}

TEST(Bodies, MustNotOverlap) {
  Setting setting = one_block();
  setting.scene.walls = {{"floor", {Vec(-0.1, -0.15), Vec(0.3, 0.0)}, {}}};
  EXPECT_EQ(refusal(setting), "none");
  setting.scene.walls.front().box.max[1] = 0.05;
  EXPECT_THAT(refusal(setting),
              testing::HasSubstr("fluid.region: error: the fluid overlaps the wall 'walls' near ("));
}

TEST(Bodies, AreWallsOfSomeParticles) {
  Setting setting = one_block();
  setting.scene.walls = {{"thin", {Vec(0.3, 0), Vec(0.31, 1)}, {}}};
  EXPECT_EQ(refusal(setting), "wall.0.box: error: wall 'thin' holds no particle at this spacing");
}

TEST(Bodies, AreToldApartByName) {
  Setting setting = one_block();
  setting.scene.walls = {{"walls", {Vec(-0.1, -0.15), Vec(0.3, 0.0)}, {}}};
  EXPECT_EQ(refusal(setting), "none");
  const std::string text = ": error: results call the walls at rest 'walls', the solid 'interface'; '",
                    needed = "', a body of its own, needs another name";
  setting.scene.walls[0].work_piece = true;
  EXPECT_EQ(refusal(setting), "wall.0.name" + text + "walls" + needed);
  setting.scene.walls[0] = {"interface", setting.scene.walls[0].box, Motion{{{0.0, 1.0, 0.0}}}};
  EXPECT_EQ(refusal(setting), "wall.0.name" + text + "interface" + needed);
  setting.scene.walls[0].name = "piston";
  EXPECT_EQ(refusal(setting), "none");
}

TEST(Bodies, MustHoldFluid) {
  Setting setting = one_block();
  const auto block = setting.parameters.regions.front();
  setting.parameters.regions.push_back({"film", {Vec(1, 1), Vec(1.02, 2)}});
  EXPECT_EQ(refusal(setting), "fluid.region.1.box: error: region 'film' holds no particle at this spacing");
  setting.parameters.regions = {block};
  setting.parameters.holes = {{{Vec(-1, -1), Vec(1, 1)}, "all"}};
  EXPECT_THAT(refusal(setting), testing::EndsWith("holds no particle at this spacing"));
}

}  // namespace
}  // namespace toryu::fluid
