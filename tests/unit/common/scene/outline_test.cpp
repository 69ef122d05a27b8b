#include "common/scene/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace toryu {
namespace {

using Ring = Outline::Ring;

const Ring square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const Ring small_square{{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}};

TEST(Outline, TurnsRingsTheRightWayRound) {
  const Ring clockwise(square.rbegin(), square.rend());
  const Outline outline({clockwise, small_square});
  EXPECT_DOUBLE_EQ(outline.area(), 3.0);
  EXPECT_DOUBLE_EQ(outline.length(), 12.0);
  EXPECT_EQ(outline.bounds().max, Vec(2, 2));
  const auto& hole = outline.rings()[1];
  EXPECT_EQ(hole[0], small_square[3]);
  // A part within the hole is material again.
  const Outline nested({square, small_square, ring_of({Vec(0.9, 0.9), Vec(1.1, 1.1)})});
  EXPECT_NEAR(nested.area(), 3.04, 1e-15);
}

TEST(Outline, ContainsWhatItsEdgesHold) {
  const Outline outline({square, small_square});
  EXPECT_TRUE(outline.contains({0.25, 1}));
  EXPECT_FALSE(outline.contains({1, 1}));
  EXPECT_FALSE(outline.contains({-0.1, 1}));
  EXPECT_FALSE(outline.contains({2.1, 0.5}));
  EXPECT_TRUE(outline.contains({0.25, 0.5}));  // in line with corners
  // On edges as a box is.
  const Box box{Vec(0, 0), Vec(2, 2)};
  for (const Vec& x :
       {Vec(0, 1), Vec(2, 1), Vec(1, 0), Vec(1, 2), Vec(0, 0), Vec(2, 2), Vec(0, 2), Vec(2, 0)})
    EXPECT_EQ(outline.contains(x), box.contains(x)) << x.transpose();
}

TEST(Outline, APointOnASharedEdgeLiesInOneOfTwo) {
  const Vec p(0.1, 0.3), q(1.7, 2.9);
  const Outline left({{p, q, Vec(-3, 2)}}), right({{p, Vec(4, -1), q}});
  for (int k = 1; k < 1000; ++k) {
    const Vec x = p + k / 1000.0 * (q - p);
    EXPECT_NE(left.contains(x), right.contains(x)) << k;
  }
}

TEST(Outline, NearestIsOnTheEdgeOrTheCorner) {
  const Outline outline({square, small_square});
  auto foot = outline.nearest({1, -0.5});
  EXPECT_EQ(foot.place, Vec(1, 0));
  EXPECT_EQ(foot.normal, Vec(0, -1));
  EXPECT_DOUBLE_EQ(foot.distance, 0.5);
  foot = outline.nearest({0.4, 1.0});  // inside, beside the hole
  EXPECT_EQ(foot.place, Vec(0.5, 1));
  EXPECT_EQ(foot.normal, Vec(1, 0));
  EXPECT_NEAR(foot.distance, -0.1, 1e-15);
  foot = outline.nearest({2.3, 2.4});
  EXPECT_EQ(foot.place, Vec(2, 2));
  EXPECT_NEAR(foot.distance, 0.5, 1e-15);
  EXPECT_TRUE(foot.normal.isApprox(Vec(0.6, 0.8)));
  foot = outline.nearest({0.47, 0.46});  // beside a corner that goes inwards
  EXPECT_EQ(foot.place, Vec(0.5, 0.5));
  EXPECT_NEAR(foot.distance, -0.05, 1e-15);
  EXPECT_TRUE(foot.normal.isApprox(Vec(0.6, 0.8)));
  EXPECT_TRUE(outline.nearest({2, 2}).normal.isApprox(Vec(1, 1).normalized()));
}

TEST(Outline, AnswersAsASearchOfAllEdgesDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  Ring star;
  for (int k = 0; k < 2000; ++k) {
    const double phi = 2 * std::numbers::pi * k / 2000, r = 1 + 0.2 * std::sin(17 * phi) + 0.05 * (k % 2);
    star.push_back(r * Vec(std::cos(phi), std::sin(phi)));
  }
  const Outline outline({star});
  for (int n = 0; n < 200; ++n) {
    const Vec x(any(random), any(random));
    double nearest = 10;
    double angle = 0;
    for (std::size_t k = 0; k < star.size(); ++k) {
      const Vec a = star[k], b = star[(k + 1) % star.size()], u = b - a;
      const double t = std::clamp((x - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (a + t * u - x).norm());
      angle += std::atan2((a - x)[0] * (b - x)[1] - (a - x)[1] * (b - x)[0], (a - x).dot(b - x));
    }
    const bool inside = angle > 1;
    EXPECT_EQ(outline.contains(x), inside);
    EXPECT_NEAR(outline.nearest(x).distance, inside ? -nearest : nearest, 1e-12);
  }
}

TEST(Outline, SharesOfAWayInside) {
  const Outline outline({square, small_square});
  const auto shares = outline.shares_inside({-1, 1}, {3, 1});
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_DOUBLE_EQ(shares[0].first, 0.25);
  EXPECT_DOUBLE_EQ(shares[0].second, 0.375);
  EXPECT_DOUBLE_EQ(shares[1].first, 0.625);
  EXPECT_DOUBLE_EQ(shares[1].second, 0.75);
  EXPECT_EQ(outline.shares_inside({0.1, 0.1}, {1.9, 0.1}), (std::vector<Outline::Share>{{0.0, 1.0}}));
  EXPECT_TRUE(outline.shares_inside({0.7, 0.7}, {1.2, 1.4}).empty());
  // Through two corners of the hole, and past one.
  const auto through = outline.shares_inside({0, 0}, {2, 2});
  ASSERT_EQ(through.size(), 2u);
  EXPECT_DOUBLE_EQ(through[0].second, 0.25);
  double past = 0;
  for (const auto& [from, to] : outline.shares_inside({0.25, 0.75}, {0.75, 0.25})) past += to - from;
  EXPECT_DOUBLE_EQ(past, 1.0);
}

TEST(Outline, AnEllipseHasItsArea) {
  const Outline ellipse({ellipse_ring({3, 4}, {2, 0.5})});
  EXPECT_NEAR(ellipse.area(), std::numbers::pi, 1e-13);
  const Outline circle({ring_of({Vec(-1, -1), Vec(1, 1), true})});
  EXPECT_NEAR(circle.length(), 2 * std::numbers::pi, 1e-4);
  EXPECT_NEAR(circle.nearest({0.3, 0.4}).distance, -0.5, 1e-4);
}

double area_less(const std::vector<Ring>& rings, const std::vector<Ring>& hole, std::size_t expected_rings) {
  const auto left = difference(Outline(rings), Outline(hole));
  EXPECT_EQ(left.size(), expected_rings);
  if (left.empty()) return 0;
  EXPECT_FALSE(fault_of(left));
  return Outline(left).area();
}

TEST(OutlineDifference, OfWhatLiesWithinBesideAndAcross) {
  EXPECT_DOUBLE_EQ(area_less({square}, {small_square}, 2), 3);
  EXPECT_DOUBLE_EQ(area_less({square}, {ring_of({Vec(3, 0), Vec(4, 1)})}, 1), 4);
  EXPECT_DOUBLE_EQ(area_less({square}, {ring_of({Vec(1, 1), Vec(4, 4)})}, 1), 3);     // a corner
  EXPECT_DOUBLE_EQ(area_less({square}, {ring_of({Vec(-1, 0.5), Vec(3, 1)})}, 2), 3);  // in two
  EXPECT_DOUBLE_EQ(area_less({small_square}, {square}, 0), 0);
  EXPECT_NEAR(area_less({square}, {ellipse_ring({1, 0}, {0.5, 0.5}, 64)}, 1), 4 - std::numbers::pi / 8,
              1e-12);
  EXPECT_DOUBLE_EQ(area_less({square, small_square}, {ring_of({Vec(1, -1), Vec(3, 3)})}, 1), 1.5);
}

TEST(OutlineDifference, OfWhatSharesEdges) {
  EXPECT_DOUBLE_EQ(area_less({square}, {square}, 0), 0);
  EXPECT_DOUBLE_EQ(area_less({square}, {ring_of({Vec(0.5, 1), Vec(1, 2)})}, 1), 3.5);  // a slot from the edge
  EXPECT_DOUBLE_EQ(area_less({square}, {ring_of({Vec(1, 0), Vec(2, 2)})}, 1), 2);      // half of it
  EXPECT_DOUBLE_EQ(area_less({square}, {ring_of({Vec(2, 0), Vec(3, 2)})}, 1), 4);      // its neighbour
  EXPECT_DOUBLE_EQ(area_less({square, small_square}, {ring_of({Vec(0.5, 0), Vec(1.5, 0.5)})}, 1), 2.5);
}

TEST(OutlineFault, NamesThePlace) {
  const auto message = [](const std::vector<Ring>& rings) {
    const auto fault = fault_of(rings);
    return fault ? fault->message : "none";
  };
  EXPECT_EQ(message({square, small_square}), "none");
  EXPECT_EQ(message({}), "has no ring");
  EXPECT_EQ(message({{{0, 0}, {1, 0}}}), "has 2 corners; an outline has at least 3");
  EXPECT_EQ(message({{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}), "has the corner (1, 0) m twice");
  EXPECT_EQ(message({{{0, 0}, {1, 1}, {2, 2}}}), "encloses no area");
  EXPECT_EQ(message({{{0, 0}, {2, 2}, {2, 0}, {0, 2.5}}}),
            "crosses or touches itself at (1.11111, 1.11111) m");
  EXPECT_EQ(message({square, {{1, 1}, {3, 1}, {3, 1.5}, {1, 1.5}}}), "crosses or touches itself at (2, 1) m");
  EXPECT_EQ(message({{{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}}), "crosses or touches itself at (1, 0) m");
  EXPECT_EQ(message({{{0, 0}, {1, 0}, {1, 2}, {1, 1}, {0, 1}}}), "crosses or touches itself at (1, 1) m");
}

}  // namespace
}  // namespace toryu
