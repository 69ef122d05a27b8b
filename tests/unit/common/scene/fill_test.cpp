#include "common/scene/fill.hpp"

#include <gtest/gtest.h>

namespace toryu {
namespace {

Box box(double x0, double y0, double x1, double y1) {
  return {Vec(x0, y0), Vec(x1, y1)};
}

TEST(Fill, PutsRowsHalfASpacingFromTheFaces) {
  const auto points = fill({box(1, 2, 1.3, 2.2)}, {}, 0.1);
  ASSERT_EQ(points.size(), 6u);
  EXPECT_TRUE(points[0].isApprox(Vec(1.05, 2.05)));
  EXPECT_TRUE(points[1].isApprox(Vec(1.15, 2.05)));
  EXPECT_TRUE(points[2].isApprox(Vec(1.25, 2.05)));
  EXPECT_TRUE(points[3].isApprox(Vec(1.05, 2.15)));
}

TEST(Fill, IsExactForWholeMultiplesWhateverTheRounding) {
  // Decimal sides and spacings, none of them a binary number, and boxes far from the origin.
  for (const double spacing : {0.000625, 0.00125, 0.0025, 0.1, 0.3, 1e-7, 1.0 / 3})
    for (int nx = 1; nx < 90; ++nx)
      for (const double shift : {0.0, 0.1, -0.079, 12.3}) {
        const double side = std::stod(fmt::format("{:.10g}", nx * spacing));
        const double height = std::stod(fmt::format("{:.10g}", 2 * spacing));
        const auto points = fill({box(shift, -shift, shift + side, -shift + height)}, {}, spacing);
        ASSERT_EQ(points.size(), 2u * static_cast<unsigned>(nx)) << spacing << " " << nx << " " << shift;
      }
}

TEST(Fill, OfTheGateHasEightRows) {
  const double spacing = 0.000625;
  const auto points = fill({box(0.1, 0, 0.105, 0.079)}, {}, spacing);
  // 0.079 / 0.000625 = 126.4: 126 centres are inside.
  EXPECT_EQ(points.size(), 8u * 126u);
  EXPECT_NEAR(points.front().x(), 0.1 + spacing / 2, 1e-15);
  EXPECT_NEAR(points.back().x(), 0.105 - spacing / 2, 1e-15);
}

TEST(Fill, KeepsCentresThatAreInsideWhereASideIsNoMultiple) {
  EXPECT_EQ(fill({box(0, 0, 0.079, 0.00125)}, {}, 0.00125).size(), 63u);   // 63.2
  EXPECT_EQ(fill({box(0, 0, 0.0794, 0.00125)}, {}, 0.00125).size(), 64u);  // 63.52
  EXPECT_EQ(fill({box(0, 0, 1.4, 1)}, {}, 1).size(), 1u);
  EXPECT_EQ(fill({box(0, 0, 0.4, 1)}, {}, 1).size(), 0u);
}

TEST(Fill, GivesACentreOnACommonEdgeToOneBox) {
  // The edge runs through centres, as exactly as rounding lets it.
  for (const double spacing : {0.1, 0.3, 0.00125})
    for (int column = 1; column < 40; ++column) {
      const double edge = (column + 0.5) * spacing, end = 50 * spacing;
      const Box whole = box(0, 0, end, spacing), left = box(0, 0, edge, spacing);
      const Box right = box(edge, 0, end, spacing);
      EXPECT_EQ(fill({whole}, {left}, spacing).size(), 50u - static_cast<unsigned>(column));
      EXPECT_EQ(fill({whole}, {right}, spacing).size(), static_cast<unsigned>(column));
      EXPECT_EQ(fill({left, right}, {}, spacing).size(), 50u);
    }
}

TEST(Fill, CountsOverlapsOnceAndLeavesHolesOut) {
  EXPECT_EQ(fill({box(0, 0, 3, 3), box(2, 2, 4, 4)}, {}, 1).size(), 12u);
  EXPECT_EQ(fill({box(0, 0, 3, 3)}, {box(1, 1, 2, 2)}, 1).size(), 8u);
  EXPECT_EQ(fill({box(0, 0, 3, 3)}, {box(-1, -1, 5, 5)}, 1).size(), 0u);
  EXPECT_EQ(fill({}, {}, 1).size(), 0u);
}

TEST(Fill, TakesTheDiscOfARoundBoxAndCutsRoundHoles) {
  Box disc = box(0, 0, 4, 4);
  disc.round = true;
  EXPECT_EQ(fill({disc}, {}, 1).size(), 12u) << "all of 4 x 4 but the corners";
  Box hole = box(1, 1, 3, 3);
  hole.round = true;
  EXPECT_EQ(fill({disc}, {hole}, 1).size(), 8u) << "a ring";
  Box ellipse = box(0, 0, 8, 2);
  ellipse.round = true;
  EXPECT_EQ(fill({ellipse}, {}, 1).size(), 12u)
      << "6 of 8 in each row: (2.5/4)^2 + (0.5/1)^2 < 1 < (3.5/4)^2 + 0.5^2";
}

TEST(Fill, RefusesASpacingThatWouldTakeAllMemory) {
  try {
    fill({box(0, 0, 0.1, 0.14)}, {}, 1e-9);
    FAIL();
  } catch (const BadKey& error) {
    EXPECT_EQ(error.key(), ".spacing");
    EXPECT_EQ(error.message(),
              "a spacing of 1e-09 m would fill a body with 1.4e+16 particles; at most 1e+08 are possible");
  }
}

TEST(Fill, SharesOneLatticeAmongBoxes) {
  const auto points = fill({box(5, 0, 6, 1), box(-0.25, 0.5, 1, 2)}, {}, 1);
  // The origin is (-0.25, 0): the first box has its centre column at 5.25.
  ASSERT_FALSE(points.empty());
  for (const auto& x : points) {
    EXPECT_DOUBLE_EQ(std::remainder(x.x() - 0.25, 1), 0);
    EXPECT_DOUBLE_EQ(std::remainder(x.y() - 0.5, 1), 0);
  }
}

TEST(Fill, WalksNoEmptySpaceBetweenBoxes) {
  const auto points = fill({box(0, 0, 1, 1), box(1e7, -1e7, 1e7 + 1, 1 - 1e7)}, {}, 0.0625);
  EXPECT_EQ(points.size(), 2u * 256u);
}

double area(const Filling& filling) {
  double sum = 0;
  for (const Vec& cell : filling.cells) sum += cell.prod();
  return sum;
}

TEST(FillToFaces, IsTheLatticeWhereThatFits) {
  const std::vector<Box> boxes{box(0, 0, 1, 0.5), box(1, 0.25, 1.5, 0.75), box(7, 3, 8, 4)};
  const std::vector<Box> holes{box(0.3, 0.1, 0.6, 0.3)};
  const auto filling = fill_to_faces({boxes, holes}, 0.05);
  EXPECT_EQ(filling.points, fill(boxes, holes, 0.05));
  EXPECT_NEAR(area(filling), 0.5 + 0.25 + 1 - 0.06, 1e-12);
  EXPECT_TRUE(filling.misfits.empty());
}

TEST(FillToFaces, HasItsRowsHalfARowFromEachFaceAndTheAreaOfTheBoxes) {
  for (const double width : {1.03, 0.97, 1.025, 2.001}) {
    const auto filling = fill_to_faces({{box(0, 0, width, 0.526)}, {}}, 0.05);
    EXPECT_NEAR(area(filling), width * 0.526, 1e-13) << width;
    const Vec first = filling.points.front(), last = filling.points.back();
    EXPECT_TRUE(first.isApprox(0.5 * filling.cells.front(), 1e-12)) << width;
    EXPECT_TRUE((Vec(width, 0.526) - last).isApprox(0.5 * filling.cells.back(), 1e-12)) << width;
    EXPECT_TRUE(filling.misfits.empty()) << width;
  }
}

TEST(FillToFaces, FitsHolesAndBodiesApartFromEachOther) {
  const auto filling = fill_to_faces(
      {{box(0, 0, 1, 1), box(2.013, 0.521, 3.013, 1.521)}, {box(0.333, 0.333, 0.666, 0.666)}}, 0.05);
  EXPECT_NEAR(area(filling), 2 - 0.333 * 0.333, 1e-12);
  const auto in_second = [](const Vec& x) { return x[0] > 1.5; };
  const auto second = std::find_if(filling.points.begin(), filling.points.end(), in_second);
  EXPECT_TRUE(second->isApprox(Vec(2.013 + 0.025, 0.521 + 0.025), 1e-12)) << "it fits the spacing by itself";
}

TEST(FillToFaces, TellsWhereNoWholeNumberOfRowsIsNear) {
  const auto thin = fill_to_faces({{box(0, 0, 1, 0.07)}, {}}, 0.05);
  EXPECT_EQ(thin.points.size(), 20u);
  ASSERT_EQ(thin.misfits.size(), 1u);
  EXPECT_EQ(thin.misfits[0].axis, 1);
  EXPECT_EQ(thin.misfits[0].rows, 1);
  const auto close =
      fill_to_faces({{box(0, 0, 1, 1)}, {box(0.3, 0.3, 0.52, 0.5), box(0.3, 0.5, 0.5, 0.7)}}, 0.05);
  ASSERT_EQ(close.misfits.size(), 1u);
  EXPECT_EQ(close.misfits[0].rows, 0);
  EXPECT_DOUBLE_EQ(close.misfits[0].begin, 0.5);
  EXPECT_DOUBLE_EQ(close.misfits[0].end, 0.52);
  EXPECT_TRUE(fill_to_faces({{box(0, 0, 1, 0.01)}, {}}, 0.05).points.empty());
}

TEST(FillToFaces, IsInLineWithWhatItTouches) {
  const Blocks water{{box(0, 0, 1.03, 0.526)}, {}};
  const auto inside = fill_to_faces(water, 0.05),
             floor = fill_to_faces({{box(-0.15, -0.15, 1.18, 0)}, {}}, 0.05, water);
  for (std::size_t k = 0; k < 21; ++k) EXPECT_NEAR(floor.points[3 + k][0], inside.points[k][0], 1e-14) << k;
  const auto elsewhere = fill_to_faces({{box(-0.15, -2, 1.15, -1)}, {}}, 0.05, water);
  EXPECT_TRUE(elsewhere.on_lattice);
}

}  // namespace
}  // namespace toryu
