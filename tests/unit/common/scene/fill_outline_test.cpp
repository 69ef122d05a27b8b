#include "common/scene/fill_outline.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "common/scene/filling_cache.hpp"

namespace toryu {
namespace {

/// Fillings of a test are of the code as it is, not of what the user's cache has kept.
[[maybe_unused]] const bool no_cache = setenv("XDG_CACHE_HOME", "/dev/null/none", 1) == 0;

using Ring = Outline::Ring;

Ring turned(const Ring& ring, double angle) {
  Ring result;
  for (const Vec& x : ring)
    result.emplace_back(std::cos(angle) * x[0] - std::sin(angle) * x[1],
                        std::sin(angle) * x[0] + std::cos(angle) * x[1]);
  return result;
}

const Ring disc = ellipse_ring({0, 0}, {10, 10});
const Ring hole = ellipse_ring({1, 0}, {3, 3});
const Ring triangle{{0, 0}, {16, 0}, {8, 13}};
const Ring angle_iron{{0, 0}, {20, 0}, {20, 6}, {6, 6}, {6, 20}, {0, 20}};

TEST(FillOutline, ATurnedRectangleHasTheLatticeOfItsOwn) {
  const double angle = std::numbers::pi / 6;
  const Ring box{{0, 0}, {8, 0}, {8, 3.1}, {0, 3.1}};
  const auto filling = fill_outline(Outline({turned(box, angle)}), 1.0);
  ASSERT_EQ(filling.points.size(), 24u);
  EXPECT_EQ(filling.rounds, 0);
  EXPECT_NEAR(filling.volume, 3.1 / 3, 1e-14);
  const auto expected = turned({{0.5, 3.1 / 6}, {7.5, 3.1 * 5 / 6}}, angle);
  EXPECT_TRUE(filling.points.front().isApprox(expected[0], 1e-14));
  EXPECT_TRUE(filling.points.back().isApprox(expected[1], 1e-14));
}

TEST(FillOutline, VolumesSumToTheAreaAndNoneIsOutside) {
  for (const auto& rings : {std::vector<Ring>{disc}, {disc, hole}, {triangle}, {angle_iron}}) {
    const Outline outline(rings);
    const auto filling = fill_outline(outline, 1.0);
    const double count = static_cast<double>(filling.points.size());
    EXPECT_NEAR(filling.volume * count / outline.area(), 1.0, 1e-12);
    EXPECT_NEAR(filling.volume, 1.0, 0.03);
    std::size_t of_first_row = 0;
    for (const Vec& x : filling.points) {
      const double depth = -outline.nearest(x).distance / std::sqrt(filling.volume);
      EXPECT_GT(depth, 0.5 - 1e-3);
      of_first_row += depth < 0.5 + 1e-6;
    }
    const double length_of_row = outline.length();
    EXPECT_NEAR(static_cast<double>(of_first_row), length_of_row, 0.1 * length_of_row);
  }
}

TEST(FillOutline, ParticlesAreEven) {
  for (const auto& rings : {std::vector<Ring>{disc}, {disc, hole}, {triangle}, {angle_iron}}) {
    const auto filling = fill_outline(Outline(rings), 0.5);
    EXPECT_LT(filling.spread, 0.01);
    double nearest = 1;
    for (std::size_t i = 0; i < filling.points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        nearest = std::min(nearest, (filling.points[i] - filling.points[j]).norm());
    EXPECT_GT(nearest, 0.75 * 0.5);
  }
}

TEST(FillOutline, IsTheSameForAnyNumberOfThreads) {
  const Outline outline({disc, hole});
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = fill_outline(outline, 1.0);
  omp_set_num_threads(3);
  const auto three = fill_outline(outline, 1.0);
  omp_set_num_threads(before);
  EXPECT_GT(one.rounds, 0);
  EXPECT_EQ(one.points, three.points);
}

/// The offset of a corner at which the outline turns back on itself is no number.
TEST(FillOutline, EndsWhereTheOutlineTurnsBackOnItself) {
  const Ring spike{{0, 0}, {6e-21, 3}, {10, 8}, {0, 8}};
  const auto filling = fill_outline(Outline({spike}), 1.0);
  EXPECT_NEAR(static_cast<double>(filling.points.size()) * filling.volume, 25, 1e-9);
}

TEST(FillOutline, IsEmptyWhereNoRowFits) {
  EXPECT_TRUE(fill_outline(Outline({{{0, 0}, {9, 0}, {9.1, 0.4}}}), 1.0).points.empty());
}

TEST(FillingCache, GivesBackEveryBit) {
  const Outline outline({disc, hole});
  const auto filling = fill_outline(outline, 2.0);
  const auto file = std::filesystem::temp_directory_path() / fmt::format("toryu_filling_{}", getpid());
  keep_filling(filling, file);
  const auto kept = read_filling(file);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->points, filling.points);
  EXPECT_EQ(kept->volume, filling.volume);
  EXPECT_EQ(kept->spread, filling.spread);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 10);  // within the last number
  EXPECT_FALSE(read_filling(file));
  std::filesystem::remove(file);
  EXPECT_NE(cached_filling(outline, 2.0), cached_filling(outline, 2.5));
  EXPECT_NE(cached_filling(outline, 2.0), cached_filling(Outline({disc}), 2.0));
}

TEST(SurfacePieces, AreClosedAndAsLongAsTheOutline) {
  const Outline outline({disc, hole});
  const auto pieces = surface_pieces(outline, 0.1);
  const auto filling = fill_outline(outline, 0.5);
  const auto areas = area_vectors(filling.points, pieces, 2.0);
  Vec sum = Vec::Zero(), moment = Vec::Zero();
  double length = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    sum += areas[i];
    length += areas[i].norm();
  }
  for (const auto& piece : pieces) moment += piece.area.cwiseProduct(piece.place);
  EXPECT_NEAR(sum.norm(), 0, 1e-12);
  EXPECT_NEAR(length / outline.length(), 1.0, 1e-3);
  EXPECT_NEAR(moment[0], outline.area(), 1e-9);  // the integral of n_x x over the surface
  EXPECT_NEAR(moment[1], outline.area(), 1e-9);
}

}  // namespace
}  // namespace toryu
