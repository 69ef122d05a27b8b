// A sum that has the same bits in any order.
#include "common/sph/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace toryu {
namespace {

TEST(ExactSum, IsTheSumInAnyOrderAndInParts) {
  std::mt19937 random(1);
  std::vector<double> parts;
  for (int k = 0; k < 1000; ++k)
    parts.push_back(std::ldexp(std::uniform_real_distribution<>(-1, 1)(random), k % 40 - 20));
  ExactSum sum;
  for (const double part : parts) sum.add(part);
  double plain = 0, backwards = 0;
  long double longer = 0;
  for (const double part : parts) plain += part, longer += part;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) backwards += *part;
  EXPECT_NE(plain, backwards) << "rounding is seen in plain sums";
  EXPECT_EQ(sum.value(), static_cast<double>(longer));
  std::shuffle(parts.begin(), parts.end(), random);
  ExactSum first, second;
  for (std::size_t k = 0; k < parts.size(); ++k) (k < 300 ? first : second).add(parts[k]);
  first.add(second);
  EXPECT_EQ(first.value(), sum.value());
}

TEST(ExactSum, LosesNothingOfSmallPartsBesideLargeOnes) {
  ExactSum sum;
  for (const double part : {1e9, 0x1p-60, -1e9}) sum.add(part);
  EXPECT_EQ(sum.value(), 0x1p-60);
}

TEST(ExactSum, IsNoNumberWhereAPartIsNone) {
  for (const double part : {std::numeric_limits<double>::quiet_NaN(), 1e300, -0x1p37}) {
    ExactSum sum, other;
    sum.add(part);
    EXPECT_TRUE(std::isnan(sum.value())) << part;
    other.add(1.0);
    other.add(sum);
    EXPECT_TRUE(std::isnan(other.value()));
  }
}

TEST(ExactSum, IsNoNumberBeyondItsLimit) {
  ExactSum sum, other;
  for (int k = 0; k < 2; ++k) sum.add(1e11);
  EXPECT_TRUE(std::isnan(sum.value()));
  other.add(1e11);
  ExactSum both = other;
  both.add(other);
  EXPECT_EQ(other.value(), 1e11);
  EXPECT_TRUE(std::isnan(both.value()));
}

}  // namespace
}  // namespace toryu
