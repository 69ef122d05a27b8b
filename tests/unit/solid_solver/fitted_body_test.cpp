/// Bodies whose particles fit an outline.
#include <gmock/gmock.h>

#include <numbers>

#include "common/scene/outline.hpp"
#include "samples.hpp"
#include "solid_solver/total_lagrangian/clamp_faces.hpp"
#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

namespace toryu::solid {
namespace {

using Ring = Outline::Ring;

Box within(std::vector<Ring> rings) {
  return box_of(Outline(std::move(rings)));
}

Parameters ring_of_rows(double rows) {
  Parameters p = free_plate(4);
  p.spacing = 1.0 / rows;
  p.regions = {{"ring", within({ellipse_ring({0, 0}, {2, 2})})}};
  p.holes = {{"bore", within({ellipse_ring({0, 0}, {1, 1})})}};
  return p;
}

Vec turned(const Vec& x, double angle) {
  return {std::cos(angle) * x[0] - std::sin(angle) * x[1], std::sin(angle) * x[0] + std::cos(angle) * x[1]};
}

Box turned(const Box& box, double angle) {
  Ring ring = ring_of(box);
  for (Vec& corner : ring) corner = turned(corner, angle);
  return within({ring});
}

TEST(FittedBody, HasTheAreaAndTheSurfaceOfItsOutline) {
  const Body body = body_of(ring_of_rows(10));
  EXPECT_NEAR(body.total_volume() / (3 * std::numbers::pi), 1.0, 1e-12);
  Vec sum = Vec::Zero();
  double length = 0;
  std::size_t of_surface = 0;
  for (const Vec& area : body.area_vector) {
    sum += area;
    length += area.norm();
    of_surface += !area.isZero(0);
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-12);
  EXPECT_NEAR(length / (6 * std::numbers::pi), 1.0, 1e-3);
  EXPECT_NEAR(static_cast<double>(of_surface), 66 + 122, 3) << "one row";
  EXPECT_EQ(body.near_surface(1.1 * body.spacing).size(), of_surface);
  for (const Vec& x : body.outside) EXPECT_FALSE(body.contains(x));
}

TEST(FittedBody, RegionsThatTouchHaveNoSurfaceBetweenThem) {
  Parameters p = ring_of_rows(8);
  p.holes.clear();
  const Ring left{{0, 0}, {1, 0}, {1.5, 2}, {0, 2}}, right{{1, 0}, {3, 0}, {3, 2}, {1.5, 2}};
  p.regions = {{"left", within({left})}, {"right", within({right})}, {"lattice", {Vec(3, 0), Vec(4, 2)}}};
  const Body body = body_of(p);
  EXPECT_NEAR(body.total_volume(), 8.0, 1e-12);
  double length = 0;
  for (const Vec& area : body.area_vector) length += area.lpNorm<1>();
  EXPECT_NEAR(length, 12.0, 1e-9);
  for (const Vec& x : body.outside)
    EXPECT_TRUE(x[0] < 0 || x[0] > 4 || x[1] < 0 || x[1] > 2) << x.transpose();
  EXPECT_TRUE(body.shape.joins({1.0, 1.0}, {1.5, 1.0})) << "across the slanted line";
  EXPECT_TRUE(body.shape.joins({2.9, 1.0}, {3.1, 1.1}));
}

TEST(FittedBody, NoBondCrossesASlantedSlot) {
  Parameters p = ring_of_rows(8);
  p.regions = {{"plate", {Vec(-2, -2), Vec(2, 2)}}};
  p.holes = {{"slot", turned(Box{Vec(-1, -0.02), Vec(1, 0.02)}, 0.5)}};
  const Body body = body_of(p);
  EXPECT_NEAR(body.total_volume(), 16 - 0.08, 1e-12);
  const Vec along = turned(Vec(1, 0), 0.5), across = turned(Vec(0, 1), 0.5);
  EXPECT_FALSE(body.shape.joins(0.08 * across, -0.08 * across));
  EXPECT_FALSE(body.shape.joins(0.9 * along + 0.08 * across, 0.95 * along - 0.08 * across));
  EXPECT_TRUE(body.shape.joins(1.1 * along + 0.08 * across, 1.1 * along - 0.08 * across));
  EXPECT_TRUE(body.shape.joins(0.98 * along + 0.1 * across, 1.03 * along - 0.1 * across)) << "round its end";
}

TEST(FittedBody, ABoxOfWholeRowsStaysALattice) {
  Parameters p = free_plate(4);
  const Body lattice = body_of(p);
  p.holes = {{"beside", within({{{1, 1}, {2, 1}, {2, 2}}})}};
  EXPECT_EQ(body_of(p).X, lattice.X);
  EXPECT_FALSE(body_of(p).has_outline());
}

TEST(FittedBody, TellsWhatIsWrong) {
  std::vector<std::string> faults;
  Parameters p = ring_of_rows(4);
  p.regions.push_back({"thread", within({{{3, 0}, {5, 0}, {5, 0.1}}})});
  p.regions.push_back({"gone", within({{{-0.2, 0}, {0.2, 0}, {0, 0.2}}})});
  p.loads = {{"wind", {Vec(8, 8), Vec(9, 9)}, Vec::Zero(), 5.0}};
  build_body(
      p, [&](const std::string& key, const std::string& message) { faults.push_back(key + ": " + message); });
  EXPECT_THAT(faults,
              testing::ElementsAre(
                  "solid.region.\"thread\".box: region 'thread' is nowhere as wide as a row of particles",
                  "solid.hole.\"bore\".box: what hole 'bore' leaves of region 'gone' has no ring",
                  "solid.load.\"wind\".box: load 'wind' acts on no surface of the solid"));
}

TEST(FilledBody, TellsOfHolesThatLeaveNothing) {
  std::vector<std::string> faults;
  Parameters p = free_plate(4);
  p.holes = {{"all", {Vec(-9, -9), Vec(9, 9)}}};
  build_body(p, [&](const std::string& key, const std::string&) { faults.push_back(key); });
  EXPECT_THAT(faults, testing::ElementsAre("solid.region.\"plate\".box"));
}

TEST(ClampFaces, CellsOfNearestParticlesAreThoseOfALattice) {
  const Body body = body_of(free_plate(4));
  VecField X, cells;
  resize(X, padded(body.size()));
  resize(cells, padded(body.size()));
  Field mobile(padded(body.size()), 1.0);
  StripOrder strips(0.02);
  for (std::size_t i = 0; i < body.size(); ++i) set(X, i, body.X[i]);
  const auto order = strips.sort(X[0], X[1], body.size());
  for (std::size_t k = 0; k < padded(body.size()); ++k) {
    const std::size_t i = order[std::min(k, body.size() - 1)];
    set(X, k, body.X[i]);
    set(cells, k, body.cell[i]);
    mobile[k] = body.X[i][0] < 0.02 || body.X[i][1] > 0.015 ? 0.0 : 1.0;  // an angle
  }
  ClusterList list;
  strips.index(X[0], body.size());
  const double reach = 2.6 * body.spacing;
  list.build(X, body.size(), X, strips, reach);
  const ClampFaces boxes(X, body.size(), Held{mobile, cells}, list, reach),
      nearest(X, body.size(), Held{mobile, cells, true}, list, reach);
  int different = 0;
  for (std::size_t i = 0; i < body.size(); ++i)
    for (std::size_t j = 0; j < body.size(); ++j) {
      ASSERT_EQ(boxes.share(i, j).has_value(), nearest.share(i, j).has_value());
      if (!boxes.share(i, j)) continue;
      EXPECT_NEAR(*boxes.share(i, j), *nearest.share(i, j), 1e-9);
      different += *boxes.share(i, j) < 1;
    }
  EXPECT_GT(different, 100);
}

TEST(FittedBody, ATurnedCantileverMovesAsTheLattice) {
  const double angle = 0.6;
  Parameters p = free_plate(6);
  p.regions = {{"root", {Vec(-0.01, 0), Vec(0, 0.02)}}, {"beam", {Vec(0, 0), Vec(0.08, 0.02)}}};
  p.clamps = {{"root", p.regions[0].box}};
  p.loads = {{"tip", {Vec(0.07, -1), Vec(1, 1)}, Vec(0, -20)}};
  p.observers = {{"tip", Vec(0.08, 0.01)}};
  const auto lattice = model_of(p);
  for (auto& region : p.regions) region.box = turned(region.box, angle);
  p.clamps[0].box = p.regions[0].box;
  p.loads[0] = {"tip", turned(Box{Vec(0.07, -0.01), Vec(0.09, 0.03)}, angle), turned(Vec(0, -20), angle)};
  p.observers[0].point = turned(p.observers[0].point, angle);
  const auto fitted = model_of(p);
  for (int part = 0; part < 2; ++part) {
    run_to(*lattice, 0.01);
    run_to(*fitted, 0.01);
    const Vec expected =
        turned({observed(*lattice, "tip_displacement_x"), observed(*lattice, "tip_displacement_y")}, angle);
    const Vec found(observed(*fitted, "tip_displacement_x"), observed(*fitted, "tip_displacement_y"));
    EXPECT_GT(expected.norm(), 1e-3);
    EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(Pressure, HasTheForceAndTheMomentOfItsSurface) {
  const double p_0 = 3e3, angle = 0.4;
  Parameters p = free_plate(5);
  const Box beam{Vec(0, 0), Vec(0.08, 0.02)};
  p.regions = {{"beam", turned(beam, angle)}};
  p.loads = {{"on top", turned(Box{Vec(0.02, 0.019), Vec(0.06, 0.021)}, angle), Vec::Zero(), p_0}};
  const auto model = model_of(p);
  Vec force = Vec::Zero();
  double moment = 0;
  for (std::size_t i = 0; i < model->particle_count(); ++i) {
    const Vec f = model->mass(i) * model->acceleration(i), x = model->body().X[i];
    force += f;
    moment += x[0] * f[1] - x[1] * f[0];
  }
  const Vec expected = p_0 * 0.04 * turned(Vec(0, -1), angle), middle = turned(Vec(0.04, 0.02), angle);
  EXPECT_NEAR((force - expected).norm(), 0, 1e-9 * expected.norm());
  EXPECT_NEAR(moment, middle[0] * expected[1] - middle[1] * expected[0], 1e-9 * expected.norm());
}

}  // namespace
}  // namespace toryu::solid
