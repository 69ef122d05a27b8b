#include "solid_solver/bonds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/run/failure.hpp"
#include "samples.hpp"

namespace toryu {
namespace {

TEST(Bonds, AreSidesAndDiagonalsOfTheLatticeAndKnowHowFarTheyStretch) {
  const SolidParameters p = free_plate(4);  // 16 x 4 particles, 5 mm apart
  const SolidBody body = body_of(p);
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

TEST(BondWatch, KeepsTheWorstAndStopsWhereAsked) {
  const SolidParameters p = free_plate(4);
  const SolidBody body = body_of(p);
  auto torn = body.X;
  torn[15] += Vec(0.1, 0);  // the corner: two sides and a diagonal
  BondWatch watch(body, {});
  watch.look(torn, 0.5);
  watch.look(body.X, 1.0);
  EXPECT_EQ(watch.worst(), std::make_pair(3L, 0L));
  BondWatch strict(body, {.stop = true});
  strict.look(body.X, 0.25);
  try {
    strict.look(torn, 0.5);
    FAIL();
  } catch (const PhysicsFailure& failure) {
    EXPECT_STREQ(failure.what(), "solid particle 14 at t = 0.5 s: stretch of a bond = 21, limit 2");
  }
}

TEST(UpdatedLagrangian, WatchesItsBondsUnasked) {
  SolidParameters p = free_plate(4);
  p.formulation = Formulation::updated_lagrangian;
  p.hourglass.reset();
  const auto model = model_of(p);
  ASSERT_EQ(model->figures().size(), 2u);
  EXPECT_EQ(model->figures()[0], std::make_pair(std::string("torn_bonds"), 0.0));
  const auto total = model_of(free_plate(4));
  EXPECT_TRUE(total->figures().empty()) << "neighbours for ever: its strain is checked";
}

}  // namespace
}  // namespace toryu
