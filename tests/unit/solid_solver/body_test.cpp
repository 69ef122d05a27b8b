#include "solid_solver/body.hpp"

#include <gmock/gmock.h>

#include "samples.hpp"

namespace toryu::solid {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::vector<std::string> faults_of(const Parameters& parameters) {
  std::vector<std::string> faults;
  build_body(parameters, [&](const std::string& key, const std::string& message) {
    faults.push_back(key + ": " + message);
  });
  return faults;
}

TEST(Body, FillsItsRegionWithRowsHalfASpacingFromTheFaces) {
  const Body body = body_of(free_plate(4));
  ASSERT_EQ(body.size(), 64u);
  EXPECT_NEAR((body.X.front() - Vec(0.0025, 0.0025)).norm(), 0, 1e-15);
  EXPECT_NEAR((body.X.back() - Vec(0.0775, 0.0175)).norm(), 0, 1e-15);
  EXPECT_NEAR(body.total_volume(), 0.08 * 0.02, 1e-15);
}

TEST(Body, FitsTheSpacingToTheSidesSoThatMassIsDensityTimesArea) {
  Parameters p = free_plate(4);
  p.spacing = 0.000625;
  p.regions = {{"gate", {Vec(0.1, 0), Vec(0.105, 0.079)}}};  // 126.4 spacings high
  const Body body = body_of(p);
  EXPECT_EQ(body.size(), 8u * 126u);
  EXPECT_NEAR(body.total_volume(), 0.005 * 0.079, 1e-15);
  EXPECT_NEAR(body.X.back()[1], 0.079 - 0.5 * 0.079 / 126, 1e-15);
}

/// A block 0.08 m x 0.02 m, 4 rows of 5 mm, worn.
Parameters worn_plate(std::vector<WornFace> worn) {
  Parameters p = free_plate(4);
  p.regions.front().worn = std::move(worn);
  return p;
}

TEST(Body, BetweenWornFacesIsThatOfAThinnerBox) {
  // 2 mm off above and 3 below leave 3 rows of 5 mm
  const Body body = body_of(worn_plate({{Side::upper, {{0, 2e-3}}}, {Side::lower, {{0, 3e-3}}}}));
  Parameters thinner = free_plate(4);
  thinner.regions.front().box = {Vec(0, 3e-3), Vec(0.08, 0.018)};
  const Body same = body_of(thinner);
  ASSERT_EQ(body.size(), same.size());
  for (std::size_t i = 0; i < body.size(); ++i) {
    EXPECT_NEAR((body.X[i] - same.X[i]).norm(), 0, 1e-16);
    EXPECT_NEAR((body.cell[i] - same.cell[i]).norm(), 0, 1e-16);
    EXPECT_NEAR((body.area_vector[i] - same.area_vector[i]).norm(), 0, 1e-16);
  }
}

TEST(Body, LosesTheAreaThatIsOff) {
  // a wedge: 0 to 4 mm over 80 mm, so 160 mm2 of 1600
  for (const Side face : {Side::upper, Side::lower}) {
    const Body body = body_of(worn_plate({{face, {{0, 0}, {0.08, 4e-3}}}}));
    EXPECT_NEAR(body.total_volume(), 0.9 * 0.08 * 0.02, 1e-15);
    const auto mean = [&](int axis) {
      double sum = 0;
      for (std::size_t i = 0; i < body.size(); ++i) sum += body.volume(i) * body.X[i][axis];
      return sum / body.total_volume();
    };
    // less the wedge's own moment, whose centre is at 2/3 of the length and a third of its height from the
    // face
    EXPECT_NEAR(mean(0), (1600 * 0.04 - 160 * 0.08 * 2 / 3) / 1440, 2e-5);
    const double wedge = face == Side::upper ? 0.02 - 4e-3 / 3 : 4e-3 / 3;
    EXPECT_NEAR(mean(1), (1600 * 0.01 - 160 * wedge) / 1440, 2e-5);
  }
  // 1 mm off the right face: 15.8 columns, 16 a little narrower
  const Body shorter = body_of(worn_plate({{Side::right, {{0, 1e-3}}}}));
  EXPECT_EQ(shorter.size(), 64u);
  EXPECT_NEAR(shorter.total_volume(), 0.079 * 0.02, 1e-15);
}

TEST(Body, CannotBeWornToLessThanRowsFill) {
  EXPECT_THAT(faults_of(worn_plate({{Side::upper, {{0, 0}, {0.08, 0.018}}}})),
              ElementsAre(testing::HasSubstr("solid.region.\"plate\".box: region 'plate' is")));
}

TEST(Body, CountsTheParticlesOfRegionsAndClamps) {
  Parameters p = free_plate(4);
  p.clamps = {{"root", {Vec(-1, -1), Vec(0.01, 1)}}};  // a clamp line between rows 2 and 3
  const Body body = body_of(p);
  EXPECT_THAT(body.counts, ElementsAre(Pair("region plate", 64), Pair("clamp root", 8)));
  EXPECT_EQ(std::count(body.held.begin(), body.held.end(), 1), 8);
}

TEST(Body, SurfaceIsClosedAndAsLongAsItsSides) {
  Parameters p = free_plate(8);
  p.regions.push_back({"neighbour", {Vec(0.08, 0), Vec(0.1, 0.02)}});
  p.holes = {{"hole", {Vec(0.03, 0.005), Vec(0.05, 0.015)}}};
  const Body body = body_of(p);
  Vec sum = Vec::Zero();
  double length = 0;
  for (const Vec& area : body.area_vector) {
    sum += area;
    length += area.lpNorm<1>();
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-15);
  EXPECT_NEAR(length, 2 * (0.1 + 0.02) + 2 * (0.02 + 0.01), 1e-12);
  EXPECT_NEAR((body.area_vector.front() - Vec(-0.0025, -0.0025)).norm(), 0, 1e-15) << "outward at the corner";
}

TEST(Body, ARingIsADiscWithADiscCutOut) {
  Parameters p = free_plate(4);
  p.spacing = 0.001;
  p.regions = {{"left", {Vec(-0.05, -0.02), Vec(-0.01, 0.02), true}},
               {"right", {Vec(-0.01, -0.02), Vec(0.03, 0.02), true}}};
  p.holes = {{"hole", {Vec(-0.045, -0.015), Vec(-0.015, 0.015), true}}};
  const Body body = body_of(p);
  double area[2] = {0, 0};
  for (std::size_t i = 0; i < body.size(); ++i) area[body.region[i]] += body.volume(i);
  EXPECT_NEAR(area[0] / (M_PI * (0.02 * 0.02 - 0.015 * 0.015)), 1.0, 0.01);
  EXPECT_NEAR(area[1] / (M_PI * 0.02 * 0.02), 1.0, 0.01);
  p.regions.push_back({"inside", {Vec(0.0, -0.005), Vec(0.01, 0.005)}});
  p.regions.push_back({"in the corner", {Vec(0.027, 0.017), Vec(0.03, 0.02)}});
  EXPECT_THAT(
      faults_of(p),
      ElementsAre(
          "solid.region.\"inside\".box: region 'inside' overlaps region 'right'; regions may touch only"));
}

TEST(Body, InterfaceIsWhatAFluidCanReachFromOutside) {
  const Body body = body_of(free_plate(10));  // spacing 2 mm, 40 x 10
  EXPECT_EQ(body.near_surface(0.0021).size(), 400u - 38u * 8u) << "one layer";
  EXPECT_EQ(body.near_surface(0.0041).size(), 400u - 36u * 6u) << "two layers";
  EXPECT_EQ(body.near_surface(0.004).size(), 400u - 36u * 6u) << "just so: all of a layer or none";
}

TEST(Body, TellsWhatIsWrongWithTheGeometry) {
  Parameters p = free_plate(4);
  p.regions.push_back({"lid", {Vec(0, 0.015), Vec(0.08, 0.0225)}});
  p.clamps = {{"nowhere", {Vec(2, 2), Vec(3, 3)}}};
  p.loads = {{"push", {Vec(2, 2), Vec(3, 3)}, Vec(1, 0)}};
  p.observers = {{"far", Vec(2, 2)}};
  EXPECT_THAT(
      faults_of(p),
      ElementsAre("solid.region.\"lid\".box: region 'lid' is 1.5 spacings long along y; rows of particles "
                  "fill it only if "
                  "that is within 10 % of a whole number",
                  "solid.region.\"lid\".box: region 'lid' overlaps region 'plate'; regions may touch only",
                  "solid.clamp.\"nowhere\".box: clamp 'nowhere' holds no particle of the solid",
                  "solid.load.\"push\".box: load 'push' acts on no particle of the solid",
                  "solid.observer.\"far\".point: observer 'far': the point (2, 2) is not in the solid: 0 "
                  "particles within "
                  "0.013 m"));
}

TEST(MaterialPoint, IsExactForLinearFieldsAlsoInACorner) {
  const Body body = body_of(free_plate(4));
  for (const Vec& point : {Vec(0, 0), Vec(0.08, 0.02), Vec(0.04, 0.01), Vec(0.013, 0.0)}) {
    const MaterialPoint observer(point, body.X, 0.013);
    const auto linear = [](const Vec& X) { return Vec(1 + 2 * X[0] - X[1], 3 * X[1]); };
    EXPECT_NEAR((observer.value([&](std::size_t i) { return linear(body.X[i]); }) - linear(point)).norm(), 0,
                1e-13);
  }
}

TEST(InitialVelocity, FollowsTheFirstModeOfABeam) {
  const InitialVelocity v{VelocityProfile::cantilever_mode_1, Vec(0, 3), Vec(1, 0), 2.0};
  EXPECT_NEAR(v.at(Vec(3, 0.7))[1], 3.0, 1e-12);
  EXPECT_NEAR(v.at(Vec(2, 0))[1] / 3.0, 0.3395, 1e-4);  // mid length, tables of beam modes
  EXPECT_EQ(v.at(Vec(0.5, 0)), Vec(0, 0));
}

TEST(InitialVelocity, FollowsTheFirstModeOfABar) {
  const InitialVelocity v{VelocityProfile::bar_mode_1, Vec(3, 0), Vec(1, 0), 2.0};
  EXPECT_NEAR(v.at(Vec(3, 0.7))[0], 3.0, 1e-12);
  EXPECT_NEAR(v.at(Vec(1 + 2.0 / 3, 0))[0], 1.5, 1e-12);
  EXPECT_EQ(v.at(Vec(0.5, 0)), Vec(0, 0));
}

TEST(InitialVelocity, AlternatesFromSquareToSquare) {
  const InitialVelocity v{VelocityProfile::alternating, Vec(1, -2), Vec(0, 0), 0.5};
  EXPECT_EQ(v.at(Vec(0.25, 0.25)), Vec(1, -2));
  EXPECT_EQ(v.at(Vec(0.75, 0.25)), Vec(-1, 2));
  EXPECT_EQ(v.at(Vec(0.75, -0.25)), Vec(1, -2));
  EXPECT_EQ(v.at(Vec(-0.25, 0.25)), Vec(-1, 2));
}

}  // namespace
}  // namespace toryu::solid
