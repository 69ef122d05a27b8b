/// When rows and frames are due.
#include "common/loop/schedule.hpp"

#include <gtest/gtest.h>

namespace toryu {
namespace {

TEST(Schedule, ComesOnceAnInterval) {
  Schedule schedule(0.1, 1);
  EXPECT_FALSE(schedule.reached(0.05));
  EXPECT_TRUE(schedule.reached(0.12));
  EXPECT_FALSE(schedule.reached(0.19));
  EXPECT_TRUE(schedule.reached(0.2));
  EXPECT_TRUE(schedule.reached(0.55));  // once for the intervals that a long window passed over
  EXPECT_FALSE(schedule.reached(0.58));
  EXPECT_TRUE(schedule.reached(0.6));
}

TEST(Schedule, BeginsWhereItIsToldAndNeverComesWithoutInterval) {
  EXPECT_TRUE(Schedule(0.1).reached(0));
  EXPECT_FALSE(Schedule(0.1, 1).reached(0));
  EXPECT_FALSE(Schedule(0).reached(1e9));
}

TEST(Schedule, GoesOnByItsCountOrWithAnotherIntervalByTheTime) {
  Schedule first(0.1), same(0.1), finer(0.04);
  first.reached(0.25);
  same.resume(first.state(), 0.28);
  EXPECT_DOUBLE_EQ(same.next(), 0.3);
  finer.resume(first.state(), 0.28);
  EXPECT_DOUBLE_EQ(finer.next(), 0.32);
}

}  // namespace
}  // namespace toryu
