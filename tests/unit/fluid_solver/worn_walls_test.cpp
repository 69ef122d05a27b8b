// Walls whose faces have worn away: where their particles stand, and how the fluid fills the space.
#include "fluid_solver/worn_walls.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

using Rows = std::vector<std::vector<double>>;

/// A floor of 10 x 4 cells of 0.1 m below y = 0, whose upper face is worn.
Wall floor_worn_by(const Rows& depth) {
  return {.name = "floor",
          .box = {Vec(0, -0.4), Vec(1, 0)},
          .motion = {},
          .work_piece = false,
          .worn = {{Side::upper, depth}}};
}

TEST(WornFace, DepthIsLinearBetweenRowsAndConstantBeyond) {
  const WornFace worn{Side::left, {{1.0, 0.2}, {3.0, 0.6}}};
  EXPECT_EQ(worn.axis(), 0);
  EXPECT_EQ(worn.outward(), -1);
  EXPECT_DOUBLE_EQ(worn.depth_at(0.0), 0.2);
  EXPECT_DOUBLE_EQ(worn.depth_at(1.5), 0.3);
  EXPECT_DOUBLE_EQ(worn.depth_at(3.0), 0.6);
  EXPECT_DOUBLE_EQ(worn.depth_at(9.0), 0.6);
  EXPECT_DOUBLE_EQ(worn.largest_depth(), 0.6);
}

TEST(WornWall, ItsParticlesGoAlongWithTheFaceAndDropOutBehind) {
  const Wall wall = floor_worn_by({{0.0, 0.0}, {1.0, 0.1}});
  const auto places =
      worn_places(wall, {Vec(0.25, -0.05), Vec(0.75, -0.05), Vec(0.75, -0.35), Vec(0.25, -0.35)});
  EXPECT_NEAR((*places[0] - Vec(0.25, -0.075)).norm(), 0, 1e-15);
  EXPECT_NEAR((*places[1] - Vec(0.75, -0.125)).norm(), 0, 1e-15);
  EXPECT_FALSE(places[2]) << "is pushed out below";
  EXPECT_NEAR((*places[3] - Vec(0.25, -0.375)).norm(), 0, 1e-15);
}

TEST(WornWall, OfTwoOppositeFacesEachMovesItsHalf) {
  Wall wall = floor_worn_by({{0.0, 0.06}});
  wall.worn.push_back({Side::lower, {{0.0, 0.02}}});
  const auto places = worn_places(wall, {Vec(0.5, -0.05), Vec(0.5, -0.15), Vec(0.5, -0.25), Vec(0.5, -0.35)});
  EXPECT_NEAR((*places[0])[1], -0.11, 1e-15);
  EXPECT_NEAR((*places[1])[1], -0.21, 1e-15);
  EXPECT_NEAR((*places[2])[1], -0.23, 1e-15);
  EXPECT_NEAR((*places[3])[1], -0.33, 1e-15);
}

/// The fluid above the floor and below a roof at rest at y = 0.5.
Filling filled(const std::vector<Wall>& walls, std::vector<Vec>& home) {
  Filling filling = fill_to_faces({{{Vec(0, 0), Vec(1, 0.5)}}, {}}, 0.1);
  home = filling.points;
  fill_worn_space(filling, home, walls, 0.1);
  return filling;
}

double area(const Filling& filling) {
  double sum = 0;
  for (const Vec& cell : filling.cells) sum += cell.prod();
  return sum;
}

TEST(WornSpace, IsFilledToTheFaceWithItsArea) {
  for (const double depth : {0.02, 0.049, 0.051, 0.08, 0.1, 0.26}) {
    std::vector<Vec> home;
    const Filling filling = filled({floor_worn_by({{0.0, depth}})}, home);
    const auto rows = static_cast<std::size_t>(5 + std::lround(depth / 0.1));
    ASSERT_EQ(filling.points.size(), 10 * rows) << depth;
    EXPECT_NEAR(area(filling), 0.5 + depth, 1e-12);
    for (std::size_t i = 0; i < filling.points.size(); ++i) {
      const double y = filling.points[i][1], half = 0.5 * filling.cells[i][1];
      EXPECT_GT(y - half, -depth - 1e-12);
      EXPECT_LT(y + half, 0.5 + 1e-12) << "the roof stands";
      EXPECT_GT(home[i][1], 0) << "a place in the region";
    }
  }
}

TEST(WornSpace, FollowsATaperColumnByColumn) {
  std::vector<Vec> home;
  const Filling filling = filled({floor_worn_by({{0.0, 0.0}, {1.0, 0.2}})}, home);
  EXPECT_NEAR(area(filling), 0.5 + 0.1, 1e-12);
  double lowest = 0;
  for (std::size_t i = 0; i < filling.points.size(); ++i)
    if (filling.points[i][0] > 0.9)
      lowest = std::min(lowest, filling.points[i][1] - 0.5 * filling.cells[i][1]);
  EXPECT_NEAR(lowest, -0.19, 1e-12);
}

TEST(WornSpace, OfDepthZeroIsTheSameBitForBit) {
  std::vector<Vec> home;
  const Filling plain = filled({}, home), worn = filled({floor_worn_by({{0.0, 0.0}})}, home);
  EXPECT_EQ(plain.points, worn.points);
  EXPECT_EQ(plain.cells, worn.cells);
}

TEST(WornSpace, AtAnEdgeOfTwoWornFacesNoParticleIsPlacedTwice) {
  const Wall block{.name = "block",
                   .box = {Vec(0.4, -0.4), Vec(1, 0)},
                   .motion = {},
                   .work_piece = false,
                   .worn = {{Side::upper, {{0.4, 0.13}}}, {Side::left, {{0.0, 0.12}}}}};
  Filling filling = fill_to_faces({{{Vec(0, 0), Vec(1, 0.5)}, {Vec(0, -0.4), Vec(0.4, 0)}}, {}}, 0.1);
  auto home = filling.points;
  fill_worn_space(filling, home, {block}, 0.1);
  EXPECT_EQ(filling.points.size(), 66u + 9u) << "six on top, four at the side, the edge's once";
  for (std::size_t i = 0; i < filling.points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((filling.points[i] - filling.points[j]).norm(), 0.05) << filling.points[i].transpose();
}

TEST(WornWall, TellsOfRemainsThatAreTooThin) {
  const auto said = thin_remains({floor_worn_by({{0.0, 0.25}})}, 0.2);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(
      said.front(),
      "wall 'floor' is left 0.15 m thick where it is worn by 0.25 m, and the fluid sees 0.2 m deep: make "
      "its box thicker by 0.05 m");
  EXPECT_TRUE(thin_remains({floor_worn_by({{0.0, 0.15}})}, 0.2).empty());
}

TEST(WornWall, OfASolverKnowsItsFacesAndSurfaceAsBefore) {
  Setting setting = empty_space();
  setting.parameters.spacing = 0.1;
  setting.parameters.wall_model.extrapolation = WallExtrapolation::fit;
  setting.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.5)}, Vec(0.1, 0)}};
  Wall floor = floor_worn_by({{0.0, 0.14}});
  floor.work_piece = true;
  setting.scene.walls = {floor};
  const WeaklyCompressible solver = setting.solver();
  const Boundary& boundary = solver.boundaries().front();
  EXPECT_EQ(boundary.count, 30u) << "the lowest row has dropped out";
  for (std::size_t k = 0; k < boundary.count; ++k) {
    const double behind = -0.14 - boundary.x[1][k];  // the face
    EXPECT_NEAR(boundary.depth_up[1][k], behind, 1e-12);
    EXPECT_EQ(boundary.upper_face[1][k] > 0, behind < 0.1);
    EXPECT_EQ(boundary.lower_face[1][k], 0) << "what has come to lie lowest is no surface";
  }
  for (std::size_t i = 0; i < solver.particles().count; ++i) EXPECT_EQ(solver.particles().v[0][i], 0.1);
}

}  // namespace
}  // namespace toryu::fluid
