#include "common/sph/cluster_list.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

namespace toryu {
namespace {

/// `count` random points about the origin, stored in strip order.
VecField cloud(std::size_t count, unsigned seed, const StripOrder& strips) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  VecField x;
  resize(x, padded(count));
  for (std::size_t i = 0; i < count; ++i) set(x, i, {place(random), 2 * place(random)});
  const auto order = strips.sort(x[0], x[1], count);
  Field scratch;
  for (auto& component : x) reorder(component, order, scratch);
  return x;
}

TEST(StripOrder, IsAPermutationAndKeepsClustersCompact) {
  const StripOrder strips(0.2);
  const VecField x = cloud(1000, 1, strips);
  double longest = 0;
  for (std::size_t i = 0; i + 1 < 1000; ++i) longest = std::max(longest, (at(x, i + 1) - at(x, i)).norm());
  EXPECT_LT(longest, 0.45);  // two strips' width, at the turn from one strip to the next
  const auto order = strips.sort(x[0], x[1], 1000);
  std::vector<std::uint32_t> identity(1000);
  std::iota(identity.begin(), identity.end(), 0u);
  EXPECT_EQ(order, identity);
}

TEST(StripOrder, TakesNoMemoryForEmptySpace) {
  StripOrder strips(1e-3);
  Field x{-1e12, 0.0, 1e-4, 1e12}, y{0, 0, 1, 0};
  strips.index(x, x.size());
  std::vector<std::size_t> seen;
  const auto look = [&](double x_min, double x_max) {
    seen.clear();
    strips.in_box(y, x_min, x_max, -2, 2, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) seen.push_back(i);
    });
    return seen.size();
  };
  EXPECT_EQ(look(-1, 1), 2u);
  EXPECT_EQ(look(-2e12, 2e12), 4u);
  EXPECT_EQ(look(5, 6), 0u);
}

TEST(ClusterList, HoldsEverySourceWithinReachOfACluster) {
  StripOrder strips(0.2);
  const std::size_t targets = 403, sources = 1001;
  const VecField x = cloud(targets, 2, strips), y = cloud(sources, 3, strips);
  strips.index(y[0], sources);
  const double reach = 0.17;
  ClusterList list;
  list.build(x, targets, y, strips, reach);
  ASSERT_EQ(list.clusters(), padded(targets) / lane_count);
  for (std::size_t c = 0; c < list.clusters(); ++c) {
    std::set<std::uint32_t> expected;
    for (std::size_t i = c * lane_count; i < std::min((c + 1) * lane_count, targets); ++i)
      for (std::uint32_t j = 0; j < sources; ++j)
        if ((at(x, i) - at(y, j)).norm() < reach) expected.insert(j);
    const auto found = list.sources(c);
    EXPECT_EQ(std::set<std::uint32_t>(found.begin(), found.end()), expected) << "cluster " << c;
    EXPECT_EQ(found.size(), expected.size()) << "no source twice";
  }
}

TEST(ClusterList, HoldsWhatIsNearTheTargetsMovedByAPeriod) {
  StripOrder strips(0.2);
  const std::size_t count = 403;
  const VecField x = cloud(count, 5, strips);
  strips.index(x[0], count);
  const double reach = 0.17;
  const std::vector<Vec> shifts{{0, 0}, {-2, 0}, {2, 0}};  // the cloud is 2 wide
  ClusterList list;
  list.build(x, count, x, strips, reach, shifts);
  std::size_t across = 0;
  for (std::size_t c = 0; c < list.clusters(); ++c) {
    EXPECT_EQ(list.near(c)[0].shift, Vec(0, 0));
    std::set<std::pair<double, std::uint32_t>> expected, found;
    for (std::size_t i = c * lane_count; i < std::min((c + 1) * lane_count, count); ++i)
      for (std::uint32_t j = 0; j < count; ++j)
        for (const Vec& shift : shifts)
          if ((at(x, i) + shift - at(x, j)).norm() < reach) expected.insert({shift[0], j});
    for (const ShiftedNeighbours& near : list.near(c))
      for (const std::uint32_t j : near.sources) {
        EXPECT_TRUE(found.insert({near.shift[0], j}).second) << "no source twice";
        across += near.shift[0] != 0;
      }
    EXPECT_EQ(found, expected) << "cluster " << c;
  }
  EXPECT_GT(across, 50u);
}

TEST(ClusterList, IsEmptyWhereThereIsNothing) {
  StripOrder strips(0.2);
  const VecField x = cloud(10, 4, strips);
  VecField none;
  resize(none, 0);
  strips.index(none[0], 0);
  ClusterList list;
  list.build(x, 10, none, strips, 0.5);
  EXPECT_EQ(list.pairs(), 0u);
  EXPECT_TRUE(list.active().empty());
}

}  // namespace
}  // namespace toryu
