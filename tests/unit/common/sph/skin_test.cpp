#include "common/sph/skin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace toryu {
namespace {

/// Points that no rounding makes alike, the last of them the farthest from zero.
VecField points(std::size_t count, double phase) {
  VecField field;
  resize(field, padded(count), 1e3);  // idle lanes hold anything
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = static_cast<double>(i) + phase;
    set(field, i, Vec(static_cast<double>(i) * std::cos(angle), static_cast<double>(i) * std::sin(angle)));
  }
  return field;
}

TEST(Skin, LargestLengthsAreThoseOfOneByOneBitForBit) {
  for (const std::size_t count : {0, 1, 7, 8, 9, 64, 101}) {
    const VecField x = points(count, 0.1), y = points(count, 0.4);
    double norm = 0, distance = 0;
    for (std::size_t i = 0; i < count; ++i) {
      norm = std::max(norm, at(x, i).squaredNorm());
      distance = std::max(distance, Vec(at(x, i) - at(y, i)).squaredNorm());
    }
    EXPECT_EQ(largest_norm(x, count), std::sqrt(norm)) << count;
    EXPECT_EQ(largest_distance(x, y, count), std::sqrt(distance)) << count;
  }
}

TEST(Skin, WhatIsNotANumberIsPassedOver) {
  VecField x = points(20, 0.1);
  const double largest = largest_norm(x, 20);
  for (const std::size_t i : {3, 17}) x[1][i] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(largest_norm(x, 20), largest);
}

TEST(Skin, IsExhaustedByBothTogether) {
  EXPECT_FALSE(skin_exhausted(0.5, 0.5, 1.0));
  EXPECT_TRUE(skin_exhausted(0.5, 0.6, 1.0));
}

}  // namespace
}  // namespace toryu
