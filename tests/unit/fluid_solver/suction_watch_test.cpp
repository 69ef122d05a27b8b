// Suction that particles do not bear.
#include "fluid_solver/suction_watch.hpp"

#include <gmock/gmock.h>

namespace toryu::fluid {
namespace suction_watch_test {

const EquationOfState state{.rho_0 = 1000, .c_0 = 20, .gamma = 1};

/// 40 particles under a pressure `p` [Pa], looked at each 0.1 s: 10 Pa go 0.1 m/s, and a spacing of 0.01 m.
struct Medium {
  Particles fluid;
  SuctionWatch watch{0.01, state};
  double time = 0;
  Medium() {
    fluid.count = 40;
    for (std::uint32_t i = 0; i < 40; ++i) fluid.id.push_back(39 - i);
    watch.look(under(0), time);
  }
  const Particles& under(double p, std::size_t count = 40) {
    fluid.rho.assign(40, state.rho_0);
    std::fill_n(fluid.rho.begin(), count, state.density(p));
    return fluid;
  }
  /// What is said after `looks` at a time `interval` [s] apart.
  std::optional<std::string> after(int looks, double p, std::size_t count = 40, double interval = 0.1) {
    std::optional<std::string> said;
    for (int n = 0; n < looks; ++n) said = watch.look(under(p, count), time += interval);
    return said;
  }
};

TEST(SuctionWatch, WarnsOfSuctionThatLasts) {
  Medium medium;
  EXPECT_FALSE(medium.after(4, -10.001));
  EXPECT_THAT(*medium.after(1, -10.001),
              testing::HasSubstr("t = 0.5 s: 40 particles of the fluid have long been "
                                 "under suction, now of up to 10 Pa"));
  medium.watch.forget();
  EXPECT_FALSE(medium.after(4, -10.001));
}

TEST(SuctionWatch, CountsTheRootOfTheSuction) {
  Medium medium;
  EXPECT_FALSE(medium.after(9, -2.5));
  EXPECT_TRUE(medium.after(2, -2.5));
}

TEST(SuctionWatch, CountsBackUnderPressure) {
  Medium medium;
  medium.after(4, -10.001);
  medium.after(4, 10.001);
  EXPECT_FALSE(medium.after(4, -10.001));
  EXPECT_FALSE(Medium().after(50, 10.0));
}

TEST(SuctionWatch, TakesNoSingleLookForALongTime) {
  EXPECT_FALSE(Medium().after(4, -1e4, 40, 10));
  EXPECT_TRUE(Medium().after(5, -1e4, 40, 10));
}

TEST(SuctionWatch, IsNotAfterAFewParticles) {
  EXPECT_FALSE(Medium().after(20, -10, 15));
  EXPECT_TRUE(Medium().after(20, -10, 16));
}

TEST(SuctionWatch, LeavesOutWhatTensileControlHelps) {
  Medium medium;
  medium.fluid.off_surface_and_walls.assign(40, 1.0);
  EXPECT_FALSE(medium.after(20, -10));
}

}  // namespace suction_watch_test
}  // namespace toryu::fluid
