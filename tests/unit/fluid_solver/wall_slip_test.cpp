// The law of slip at walls and its solution together with the shear rate there, by numbers worked by hand.
#include "fluid_solver/terms/wall_slip.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace toryu::fluid {
namespace {

constexpr double any = std::numeric_limits<double>::infinity();  // a wall that bears every traction

auto newtonian(double eta) {
  return [eta](double gdot) { return eta * gdot; };
}

TEST(SlipSpeed, IsALineAPowerOrNothingBelowTheThreshold) {
  EXPECT_DOUBLE_EQ(slip_speed({.coefficient = 3e-7}, 1e5), 0.03);
  EXPECT_DOUBLE_EQ(slip_speed({.coefficient = 2, .exponent = 3}, 5), 250);
  EXPECT_DOUBLE_EQ(slip_speed({.coefficient = 2, .exponent = 3, .threshold = 4}, 5), 2);
  EXPECT_EQ(slip_speed({.coefficient = 2, .exponent = 0.5, .threshold = 4}, 4), 0);
}

TEST(Slide, OfALineIsThatOfTheSlipLength) {
  // gdot + 5 * 0.3 * 2 gdot = 7
  const Slide found = slide({.coefficient = 0.3}, newtonian(2), 7, 5, any);
  EXPECT_NEAR(found.stress, 2 * 1.75, 1e-8);
  EXPECT_NEAR(found.speed, 0.3 * 2 * 1.75, 1e-8);
}

TEST(Slide, OfAPowerSolvesItsEquation) {
  // gdot + 2 gdot^2 = 10
  const Slide found = slide({.coefficient = 0.5, .exponent = 2}, newtonian(1), 10, 4, any);
  EXPECT_NEAR(found.stress, 2, 1e-8);
  EXPECT_NEAR(found.speed, 0.5 * 4, 1e-8);
}

TEST(Slide, OfAMediumThatThinsSolvesItsEquation) {
  // tau = 3 gdot^0.5, u_s = 0.25 tau^2 = 2.25 gdot: gdot (1 + 4 * 2.25) = 20
  const auto tau = [](double gdot) { return 3 * std::sqrt(gdot); };
  const Slide found = slide({.coefficient = 0.25, .exponent = 2}, tau, 20, 4, any);
  EXPECT_NEAR(found.stress, 3 * std::sqrt(2.0), 1e-8);
  EXPECT_NEAR(found.speed, 4.5, 1e-8);
}

TEST(Slide, BeginsAboveTheThreshold) {
  // gdot + 5 * 0.3 (2 gdot - 1) = 7
  const SlipLaw law{.coefficient = 0.3, .exponent = 1, .threshold = 1};
  EXPECT_NEAR(slide(law, newtonian(2), 7, 5, any).stress, 2 * 8.5 / 4, 1e-8);
  EXPECT_NEAR(slide(law, newtonian(2), 7, 5, any).speed, 0.3 * (2 * 8.5 / 4 - 1), 1e-8);
  const Slide sticks = slide({.coefficient = 0.3, .exponent = 1, .threshold = 15}, newtonian(2), 7, 5, any);
  EXPECT_EQ(sticks.speed, 0);
  EXPECT_EQ(sticks.stress, 14);
}

TEST(Slide, IsNoneWithoutACoefficientAndFreeWithoutBound) {
  const Slide sticks = slide({.coefficient = 0}, newtonian(2), 7, 5, any);
  EXPECT_EQ(sticks.speed, 0);
  EXPECT_EQ(sticks.stress, 14);
  const Slide free = slide({.coefficient = 1e12}, newtonian(2), 7, 5, any);
  EXPECT_NEAR(free.speed, 7.0 / 5, 1e-8);
  EXPECT_NEAR(free.stress, 0, 1e-8);
  EXPECT_EQ(slide({.coefficient = 1}, newtonian(2), 0, 5, any).speed, 0) << "a medium at rest";
  EXPECT_EQ(slide({.coefficient = 1}, newtonian(2), 7, 0, any).speed, 0) << "no medium";
}

TEST(Slide, SolvesWhateverIsSteepOrLarge) {
  for (const double m : {0.1, 0.5, 1.0, 2.2, 10.0})
    for (const double b : {1e-40, 1e-20, 1e-7, 1.0})
      for (const double threshold : {0.0, 1e4})
        for (const double n : {0.2, 1.0, 1.5}) {
          const auto tau = [n](double gdot) { return 1e4 * std::pow(gdot, n); };
          const SlipLaw law{b, m, threshold};
          const double gdot_0 = 300, k = 2e4;
          const Slide found = slide(law, tau, gdot_0, k, any);
          const auto place = testing::Message()
                             << "m " << m << " b " << b << " threshold " << threshold << " n " << n;
          EXPECT_NEAR(std::pow(found.stress / 1e4, 1 / n) + k * found.speed, gdot_0, 1e-9 * gdot_0) << place;
          EXPECT_GE(found.speed, slip_speed(law, found.stress * (1 - 1e-9)) * (1 - 1e-6) - 1e-11 * gdot_0 / k)
              << place;
          EXPECT_LE(found.speed, slip_speed(law, found.stress * (1 + 1e-9)) * (1 + 1e-6) + 1e-11 * gdot_0 / k)
              << place;
        }
}

TEST(Slide, IsRuledByTheSmallerTraction) {
  // the law alone: tau 3.5, u_s 1.05
  const Slide rubbed = slide({.coefficient = 0.3}, newtonian(2), 7, 5, 3.0);
  EXPECT_NEAR(rubbed.stress, 3.0, 1e-8);
  EXPECT_NEAR(rubbed.speed, (7 - 1.5) / 5, 1e-8) << "what is left of the shear slides";
  EXPECT_NEAR(slide({.coefficient = 0.3}, newtonian(2), 7, 5, 4.0).stress, 3.5, 1e-8);
  const Slide parted = slide({.coefficient = 0.3}, newtonian(2), 7, 5, 0.0);
  EXPECT_EQ(parted.stress, 0);
  EXPECT_NEAR(parted.speed, 7.0 / 5, 1e-12);
}

}  // namespace
}  // namespace toryu::fluid
