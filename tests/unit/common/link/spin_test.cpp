#include "common/link/spin.hpp"

#include <gtest/gtest.h>

namespace toryu {
namespace {

using namespace std::chrono_literals;

/// Waits of `length` each, that spin as long as they may and are given this share of a core; returns the
/// spinning of the last.
Spin::Duration wait_often(Spin& spin, Spin::Duration& now, Spin::Duration length, double share = 1) {
  Spin::Duration spun{0};
  for (int n = 0; n < 100; ++n) {
    spun = std::min(spin.budget(now), length);
    now += length;
    const auto processor = std::chrono::duration_cast<Spin::Duration>(share * spun);
    spin.note(now, length, spun, processor);
  }
  return spun;
}

TEST(Spin, ShortWaitsAreSpentAwake) {
  Spin spin;
  Spin::Duration now = 1h;
  EXPECT_EQ(wait_often(spin, now, 20us), 20us);
  EXPECT_EQ(wait_often(spin, now, 150us), 150us);
}

TEST(Spin, LongWaitsSleepAtOnce) {
  Spin spin;
  Spin::Duration now = 1h;
  EXPECT_EQ(wait_often(spin, now, 1ms), 0us);
}

TEST(Spin, OneLongWaitAmongShortOnesSpinsForABoundedTimeAndIsForgotten) {
  Spin spin;
  Spin::Duration now = 1h;
  wait_often(spin, now, 50us);
  EXPECT_LE(spin.budget(now), Spin::longest);
  spin.note(now, 1s, spin.budget(now), spin.budget(now));
  EXPECT_EQ(wait_often(spin, now, 50us), 50us);
}

TEST(Spin, CeasesForAWhileWhereAnotherTakesTheCore) {
  Spin spin;
  Spin::Duration now = 1h;
  wait_often(spin, now, 50us);
  spin.note(now, 3ms, 3ms, 20us);
  EXPECT_EQ(spin.budget(now), 0us);
  EXPECT_EQ(spin.budget(now + 90ms), 0us);
  EXPECT_GT(spin.budget(now + 110ms), 0us);
}

TEST(Spin, GoesOnWhereThreadsOfTheRunShareTheCore) {
  Spin spin;
  Spin::Duration now = 1h;
  EXPECT_EQ(wait_often(spin, now, 100us, 0.3), 100us);
}

TEST(Spin, CeasesForLongerEachTime) {
  Spin spin;
  Spin::Duration now = 1h;
  int spinning = 0;
  while (now < 1h + 20s) {
    const auto spun = std::min<Spin::Duration>(spin.budget(now), 50us);
    spinning += spun > 0us;
    now += 1ms;
    spin.note(now, 50us, spun > 0us ? 3ms : 0ms, spun);
  }
  EXPECT_LT(spinning, 30) << "of 20,000 waits";
}

TEST(SpinningWait, TellsWhetherThereIsNewsAndNotesHowLongItWas) {
  Spin spin;
  const auto now = [] { return std::chrono::steady_clock::now().time_since_epoch(); };
  bool told = false;
  for (int n = 0; n < 1000 && !told; ++n) {  // where another program takes the core, the time is over at once
    SpinningWait waiting(spin);
    told = waiting.look([] { return true; });
    spin = {};
  }
  EXPECT_TRUE(told);
  EXPECT_FALSE(SpinningWait(spin).look([] { return false; })) << "ends when it is time to sleep";
  for (int n = 0; n < 20; ++n) {
    SpinningWait waiting(spin);
    std::this_thread::sleep_for(2ms);
  }
  EXPECT_EQ(spin.budget(now() + 10s), 0us);
}

}  // namespace
}  // namespace toryu
