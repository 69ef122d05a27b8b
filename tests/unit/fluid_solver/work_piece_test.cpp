// The surface of work pieces, rigid ones and the solid's interface.
#include "fluid_solver/work_piece.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "common/scene/fill_outline.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

/// Spacing 0.05: a floor, and a work piece of 4 x 3 particles on it; fluid far away.
Setting piece_on_a_floor() {
  Setting setting = empty_space();
  setting.scene.walls = {
      {"floor", {Vec(-0.5, -0.15), Vec(0.5, 0)}, {}},
      {.name = "piece", .box = {Vec(0, 0), Vec(0.2, 0.15)}, .motion = {}, .work_piece = true}};
  setting.parameters.regions = {{"drop", {Vec(0, 1), Vec(0.2, 1.2)}, Vec::Zero()}};
  return setting;
}

const Boundary& boundary_of(const WeaklyCompressible& solver, const std::string& name) {
  for (const auto& boundary : solver.boundaries())
    if (boundary.name == name) return boundary;
  throw std::out_of_range(name);
}

TEST(WorkPiece, ThatIsAnOutlineHasItsLengthAndNormals) {
  const Wall wall{.name = "pin", .box = box_of(Outline({ellipse_ring({1, 2}, {0.5, 0.5})})), .motion = {}};
  const auto points = fill_outline(*wall.box.outline, 0.05).points;
  Vec sum = Vec::Zero();
  double length = 0;
  const auto faces = faces_of(wall, points, 0.05, {Vec::Zero()});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec area = faces[k].upper - faces[k].lower, outward = points[k] - Vec(1, 2);
    sum += area;
    length += area.norm();
    EXPECT_EQ(area.isZero(0), outward.norm() < 0.46);
    if (!area.isZero(0)) {
      EXPECT_GT(area.dot(outward), 0.998 * area.norm() * outward.norm());
    }
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-12);
  EXPECT_NEAR(length / M_PI, 1.0, 1e-3);
}

/// Area vectors over the spacing, by id: row by row from the smallest corner.
std::vector<Vec> faces(const Boundary& piece) {
  std::vector<Vec> by_id(piece.count);
  for (std::size_t k = 0; k < piece.count; ++k)
    by_id[piece.id[k]] = (at(piece.upper_face, k) - at(piece.lower_face, k)) / 0.05;
  return by_id;
}

void expect_near(const std::vector<Vec>& found, const std::vector<Vec>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_LT((found[k] - expected[k]).norm(), 1e-12) << k << ": " << found[k].transpose();
}

TEST(WorkPiece, OfAPeriodicSceneGoesOnBeyondItsEnds) {
  Setting setting = empty_space();
  setting.scene.domain = {Vec(0, -1), Vec(1, 1)};
  setting.scene.periodic = Periodic::x;
  setting.scene.walls = {
      {.name = "piece", .box = {Vec(0, -0.15), Vec(1, 0)}, .motion = {}, .work_piece = true}};
  setting.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.2)}, Vec::Zero()}};
  const WeaklyCompressible solver = setting.solver();
  for (const Vec& face : faces(boundary_of(solver, "piece"))) EXPECT_EQ(face[0], 0);
}

/// Spacing 0.05, about an axis: a pin of 2 rows of 4 on it, and a bore of radius 0.3.
Setting pin_in_a_bore() {
  Setting setting = empty_space();
  setting.scene.geometry = Geometry::axisymmetric;
  setting.scene.walls = {
      {.name = "pin", .box = {Vec(0, 0), Vec(0.2, 0.1)}, .motion = {}, .work_piece = true},
      {.name = "bore", .box = {Vec(0, 0.3), Vec(0.2, 0.35)}, .motion = {}, .work_piece = true}};
  setting.parameters.regions = {{"medium", {Vec(0, 0.1), Vec(0.2, 0.3)}, Vec::Zero()}};
  return setting;
}

TEST(WorkPiece, HasNoFaceOnTheAxis) {
  const WeaklyCompressible solver = pin_in_a_bore().solver();
  expect_near(faces(boundary_of(solver, "pin")),
              {{-1, 0}, {0, 0}, {0, 0}, {1, 0}, {-1, 1}, {0, 1}, {0, 1}, {1, 1}});
}

TEST(WorkPiece, HasTheAreasOfItsRings) {
  const WeaklyCompressible solver = pin_in_a_bore().solver();
  const double pi = std::numbers::pi;
  const auto ring_of = [](const Boundary& body, std::uint32_t id, std::size_t point) {
    for (std::size_t k = 0; k < body.count; ++k) {
      if (body.id[k] != id) continue;
      const Faces faces{at(body.lower_face, k), at(body.upper_face, k)};
      const SurfacePoint found = surface_points(faces).at(point);
      return found.area_vector.norm() * circumference_of(found, faces, at(body.x, k));
    }
    return 0.0;
  };
  const Boundary &pin = boundary_of(solver, "pin"), &bore = boundary_of(solver, "bore");
  EXPECT_NEAR(ring_of(pin, 5, 0), 2 * pi * 0.1 * 0.05, 1e-15) << "its side is at r = 0.1, not at 0.075";
  EXPECT_NEAR(ring_of(pin, 0, 0), pi * 0.05 * 0.05, 1e-15) << "the disc on the axis";
  EXPECT_NEAR(ring_of(pin, 4, 0), std::hypot(pi * (0.1 * 0.1 - 0.05 * 0.05), 2 * pi * 0.1 * 0.05), 1e-15)
      << "the edge";
  EXPECT_NEAR(ring_of(bore, 1, 0), 2 * pi * 0.3 * 0.05, 1e-15) << "one row thick: inside";
  EXPECT_NEAR(ring_of(bore, 1, 1), 2 * pi * 0.35 * 0.05, 1e-15) << "and outside";
}

TEST(WorkPiece, IsABodyOfItsOwnWithOpenFacesOnly) {
  const WeaklyCompressible solver = piece_on_a_floor().solver();
  ASSERT_EQ(solver.boundaries().size(), 2u);
  const Boundary& piece = boundary_of(solver, "piece");
  EXPECT_FALSE(piece.moves());
  expect_near(faces(piece), {{-1, 0},
                             {0, 0},
                             {0, 0},
                             {1, 0},  // on the floor
                             {-1, 0},
                             {0, 0},
                             {0, 0},
                             {1, 0},  //
                             {-1, 1},
                             {0, 1},
                             {0, 1},
                             {1, 1}});
  EXPECT_FALSE(boundary_of(solver, "walls").is_work_piece());
}

TEST(WorkPiece, StandsOnAWallWhoseLatticeDoesNotMatch) {
  Setting setting = piece_on_a_floor();
  setting.scene.walls[0].box = {Vec(-0.523, -0.16), Vec(0.5, -0.01)};
  const auto found = faces(boundary_of(setting.solver(), "piece"));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(found[k][1], 0) << k;
}

TEST(WorkPiece, HasFacesWhereAWallThatMovesWillBareThem) {
  Setting setting = piece_on_a_floor();
  setting.scene.walls[0].motion = Motion{{{0.0, 1.0, 0.0}}};
  const auto found = faces(boundary_of(setting.solver(), "piece"));
  EXPECT_LT((found[0] - Vec(-1, -1)).norm(), 1e-12);
  EXPECT_LT((found[1] - Vec(0, -1)).norm(), 1e-12);
}

TEST(WorkPiece, MayMove) {
  Setting setting = piece_on_a_floor();
  setting.scene.walls[1].motion = Motion{{{0.0, 0.4, 0.0}}};
  WeaklyCompressible solver = setting.solver();
  const auto before = faces(boundary_of(solver, "piece"));
  run_until(solver, 0.3);
  const Boundary& piece = boundary_of(solver, "piece");
  EXPECT_TRUE(piece.moves());
  for (std::size_t k = 0; k < piece.count; ++k) EXPECT_EQ(at(piece.v, k), Vec(0.4, 0));
  expect_near(faces(piece), before);
}

/// A solid of half the fluid's spacing on the floor, as it registers itself: it knows no walls.
TEST(WorkPiece, IsTheSolidLessTheFacesOnWalls) {
  Setting setting = piece_on_a_floor();
  setting.scene.walls.pop_back();
  WeaklyCompressible solver = setting.solver();
  Interface interface;
  interface.spacing = 0.025;
  for (const double y : {0.0125, 0.0375})
    for (const double x : {0.0125, 0.0375, 0.0625}) {
      interface.id.push_back(static_cast<std::uint32_t>(interface.id.size()));
      interface.position.insert(interface.position.end(), {x, y});
      interface.volume.push_back(0.025 * 0.025);
      const double side = x < 0.02 ? -0.025 : x > 0.05 ? 0.025 : 0;
      interface.area_vector.insert(interface.area_vector.end(), {side, y < 0.02 ? -0.025 : 0.025});
    }
  solver.attach(interface);
  expect_near(faces(boundary_of(solver, "interface")),
              {{-0.5, 0}, {0, 0}, {0.5, 0}, {-0.5, 0.5}, {0, 0.5}, {0.5, 0.5}});
}

double length(const std::vector<SurfacePoint>& points) {
  double sum = 0;
  for (const auto& point : points) sum += point.area_vector.norm();
  return sum;
}

/// All surface points of a body, by id.
std::vector<SurfacePoint> points_of(const Boundary& piece) {
  std::vector<SurfacePoint> all;
  for (std::size_t k = 0; k < piece.count; ++k)
    for (const auto& point : surface_points({at(piece.lower_face, k), at(piece.upper_face, k)}))
      all.push_back(point);
  return all;
}

TEST(WorkPiece, OfOneRowHasTwoSides) {
  Setting setting = piece_on_a_floor();
  setting.scene.walls[1].box = {Vec(0, 0.2), Vec(0.5, 0.25)};
  const WeaklyCompressible solver = setting.solver();
  const auto points = points_of(boundary_of(solver, "piece"));
  EXPECT_EQ(points.size(), 20u);
  Vec sum = Vec::Zero();
  for (const auto& point : points) sum += point.area_vector;
  EXPECT_LT(sum.norm(), 1e-12) << "closed";
  // both faces of 8 in the middle, corners cut at the ends
  EXPECT_NEAR(length(points), 16 * 0.05 + 4 * 0.05 * std::sqrt(1.25), 1e-12);
}

TEST(WorkPiece, OfRowsThatAreStackedHasItsOuterFaces) {
  Setting setting = piece_on_a_floor();
  setting.scene.walls[1].box = {Vec(0, 0), Vec(0.5, 0.05)};
  setting.scene.walls.push_back(
      {.name = "upper", .box = {Vec(0, 0.05), Vec(0.5, 0.1)}, .motion = {}, .work_piece = true});
  for (const bool moving : {false, true}) {
    for (Wall& wall : setting.scene.walls)
      if (moving) wall.motion = Motion{{{0.0, 0.4, 0.0}}};
    const WeaklyCompressible solver = setting.solver();
    EXPECT_EQ(points_of(boundary_of(solver, "piece")).size(), 2u) << "its ends";
    EXPECT_EQ(points_of(boundary_of(solver, "upper")).size(), 10u) << "its upper side";
  }
}

TEST(SurfacePoints, ShareEachFaceAmongThem) {
  EXPECT_TRUE(surface_points({}).empty());
  EXPECT_EQ(surface_points({Vec(1, 0), Vec(0, 1)}).size(), 1u) << "a corner";
  const auto all = surface_points({Vec(1, 1), Vec(1, 1)});
  EXPECT_EQ(all.size(), 4u);
  double faces = 0;
  for (const auto& point : all) faces += point.area_vector.lpNorm<1>();
  EXPECT_DOUBLE_EQ(faces, 4) << "a particle by itself has four";
}

}  // namespace
}  // namespace toryu::fluid
