#include "solid_solver/bonds.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/error/failure.hpp"
#include "samples.hpp"
#include "tests/said.hpp"

namespace toryu::solid {
namespace {

Mat turned_by(double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}
Mat sheared_by(double gamma) {
  Mat F;
  F << 1, gamma, 0, 1;
  return F;
}
std::vector<Vec> moved(std::vector<Vec> x, const Mat& F) {
  for (Vec& place : x) place = F * place;
  return x;
}

TEST(Bonds, AreSidesAndDiagonalsOfTheLatticeAndKnowHowFarTheyStretch) {
  const Parameters p = free_plate(4);  // 16 x 4 particles, 5 mm apart
  const Body body = body_of(p);
  const Bonds bonds(body, {});
  auto x = body.X;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (x[i][0] > 0.04) x[i] += Vec(0.0061, 0);  // between columns 8 and 9: from 5 mm to 11.1 mm
  Stretches found = bonds.stretches(x);
  EXPECT_NEAR(found.largest, 11.1 / 5.0, 1e-12);
  EXPECT_NEAR(found.smallest, 1.0, 1e-12);
  EXPECT_EQ(found.torn, 4) << "the sides; diagonals are 1.72 times as long as they were";
  EXPECT_NEAR(body.X[found.longest][0], 0.0375, 1e-12);
  EXPECT_EQ(found.clumped, 0);

  for (std::size_t i = 0; i < body.size(); ++i) x[i] = 0.45 * body.X[i];
  found = bonds.stretches(x);
  EXPECT_NEAR(found.strain(), 0.55, 1e-12);
  EXPECT_EQ(found.clumped, 4 * 15 + 16 * 3 + 2 * 15 * 3) << "all of them";
}

TEST(Bonds, KnowHowFarTheyTurn) {
  const Body body = body_of(free_plate(4));
  const Bonds bonds(body, {});
  for (const double angle : {0.3, -2.5}) {
    const Stretches found = bonds.stretches(moved(body.X, turned_by(angle)));
    EXPECT_NEAR(found.turn, std::abs(angle), 1e-7);
    EXPECT_NEAR(found.strain(), 0, 1e-12);
  }
  // sheared: the body turns by atan 0.55/2, diagonals become 1.304 times as long
  const Stretches found = bonds.stretches(moved(body.X, sheared_by(0.55)));
  EXPECT_NEAR(found.turn, std::atan(0.55 / 2), 1e-7);
  EXPECT_NEAR(found.strain(), std::sqrt((1.55 * 1.55 + 1) / 2) - 1, 1e-12);
}

TEST(Bonds, TellAMovedLatticeFromATurn) {
  const Body body = body_of(free_plate(4));
  const Bonds bonds(body, {});
  const auto zigzag = [&](double share) {  // rows slide past each other to and fro
    auto x = body.X;
    for (std::size_t i = 0; i < body.size(); ++i)
      x[i][0] += share * body.spacing * (std::lround(body.X[i][1] / body.spacing - 0.5) % 2 == 0 ? 1 : -1);
    return x;
  };
  const Stretches found = bonds.stretches(zigzag(0.1));
  EXPECT_GT(found.rearranged, 0.1);
  EXPECT_LT(found.turn, 0.08) << "the bonds between rows lean by 0.2 rad";
  for (const Mat& F : {turned_by(1.0), sheared_by(0.5)})
    EXPECT_LT(bonds.stretches(moved(body.X, F)).rearranged, 1e-12);
  EXPECT_GT(bonds.stretches(moved(zigzag(0.1), turned_by(1.0))).rearranged, 0.1);
}

TEST(BondWatch, BlamesNoTurnWhereTheLatticeHasMoved) {
  const Body body = body_of(free_plate(4));
  const Said said;
  const BondWatch watch(body, {}, {.turn = 0.2, .strain = 0.3, .rearranged = 0.1});
  BondWatch::State state;
  auto x = body.X;
  x[20] += Vec(0.3 * body.spacing, 0);  // one particle: bonds beside it lean by 0.3 rad
  for (int n = 0; n < 2; ++n) watch.check(state, x, 0.5);
  EXPECT_EQ(said.times("has turned"), 0) << said.text();
  EXPECT_EQ(said.times("particles of the solid have left their arrangement at t = 0.5 s"), 1) << said.text();
  EXPECT_EQ(said.times("left their arrangement"), 1) << said.text();
}

TEST(BondWatch, SaysOnceThatTheStressIsBeyondAnEdge) {
  const Body body = body_of(free_plate(4));
  const Said said;
  const BondWatch watch(body, {}, {.turn = 0.7, .strain = 0.3, .rearranged = 0.1});
  BondWatch::State state;
  watch.check(state, moved(body.X, turned_by(0.6)), 0.1);
  watch.check(state, moved(body.X, sheared_by(0.5)), 0.2);
  EXPECT_EQ(said.text(), "");
  for (int n = 0; n < 2; ++n) watch.check(state, moved(body.X, turned_by(0.8)), 0.3);
  for (int n = 0; n < 2; ++n) watch.check(state, moved(body.X, sheared_by(0.6)), 0.4);
  EXPECT_EQ(said.times("cases/rigid_rotation/turn_map.toml"), 1) << said.text();
  EXPECT_EQ(said.times("cases/patch_test/jaumann_map.toml"), 1) << said.text();
}

TEST(BondWatch, KeepsTheWorstAndStopsWhereAsked) {
  const Parameters p = free_plate(4);
  const Body body = body_of(p);
  auto torn = body.X;
  torn[15] += Vec(0.1, 0);  // the corner: two sides and a diagonal
  const BondWatch watch(body, {}, {});
  BondWatch::State state;
  watch.check(state, torn, 0.5);
  watch.check(state, body.X, 1.0);
  EXPECT_EQ(state.worst.torn, 3);
  EXPECT_EQ(state.worst.clumped, 0);
  EXPECT_NEAR(state.worst.strain(), 20, 1e-9);
  const BondWatch strict(body, {.stop = true}, {});
  strict.check(state, body.X, 0.25);
  try {
    strict.check(state, torn, 0.5);
    FAIL();
  } catch (const PhysicsFailure& failure) {
    EXPECT_STREQ(failure.what(), "solid particle 14 at t = 0.5 s: stretch of a bond = 21, limit 2");
  }
}

TEST(UpdatedLagrangian, WatchesItsBondsUnasked) {
  Parameters p = free_plate(4);
  p.formulation = Formulation::updated_lagrangian;
  p.hourglass.reset();
  const auto model = model_of(p);
  ASSERT_EQ(model->figures().size(), 6u);
  EXPECT_EQ(model->figures()[0], std::make_pair(std::string("torn_bonds"), 0.0));
  const auto total = model_of(free_plate(4));
  EXPECT_TRUE(total->figures().empty()) << "neighbours for ever: its strain is checked";
}

}  // namespace
}  // namespace toryu::solid
