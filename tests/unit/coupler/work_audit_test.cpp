/// What the fluid gives to the interface against what the solid takes from it.
#include "coupler/work_audit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace toryu::coupling {
namespace {

InterfaceLoad force(double x, double friction = 0) {
  InterfaceLoad load;
  load.force = {x, 0};
  if (friction != 0) load.friction_force = {friction, 0};
  return load;
}

std::vector<double> at(double x) {
  return {x, 0};
}

TEST(WorkAudit, IsForceTimesTheWayOfEachSide) {
  WorkAudit audit(at(1));
  audit.note(force(10), {}, at(1), force(10), {at(1.5), {}}, 0);
  EXPECT_DOUBLE_EQ(audit.given(), 0);  // the fluid's copy stands still in the first window
  EXPECT_DOUBLE_EQ(audit.taken(), 5);
  audit.note(force(4, 2), {}, at(1.5), force(4, 2), {at(1.75), {}}, 0);
  EXPECT_DOUBLE_EQ(audit.given(), 3);
  EXPECT_DOUBLE_EQ(audit.taken(), 6.5);
  EXPECT_DOUBLE_EQ(audit.made(), 3.5);
}

TEST(WorkAudit, CountsWhatAnImpedanceTakesAndWhatItsImpulseDoesToTheFluid) {
  WorkAudit audit(at(1));
  InterfaceLoad load = force(10);
  load.work_of_impulse = -0.75;
  // the copy from 1.25 to 1.5, the solid from 1 to 1.5
  audit.note(load, at(1.25), at(1.5), load, {at(1.5), {}, {0.25, 0}, 0.5}, 0);
  EXPECT_DOUBLE_EQ(audit.given(), 2.5 + 0.75);
  EXPECT_DOUBLE_EQ(audit.taken(), 5 + 0.5);
}

/// A mass on the spring of a fluid, computed by a serial scheme: the fluid's copy of the interface goes to
/// where the solid was a window before, and the mean of its force on that way moves the solid. `damping` of
/// the solid [1 a window] takes away what the lag feeds.
bool feeds(double cycles_per_window, double damping, int windows) {
  const double omega = 2 * M_PI * cycles_per_window, k = omega * omega;
  WorkAudit audit(at(0));
  double x = 0, v = omega, copy = 0;
  for (int n = 0; n < windows; ++n) {
    const InterfaceLoad load = force(-k * (copy + x) / 2);
    copy = x;
    v += load.force[0] - damping * v;
    x += v;
    audit.note(load, {}, at(copy), load, {at(x), {}}, 0.5 * v * v);
    if (audit.feeds()) return true;
  }
  return false;
}

TEST(WorkAudit, TellsThatTheLagFeedsAMode) {
  EXPECT_FALSE(feeds(0.01, 0.1, 10000));
  EXPECT_FALSE(feeds(0.01, 0, 100));
  EXPECT_TRUE(feeds(0.01, 0, 1000));  // by a fifth a cycle, from a lag of one window
  EXPECT_TRUE(feeds(0.25, 0, 100));
}

TEST(WorkAudit, DoesNotTakeTheRoundingOfABodyAtRestForWork) {
  WorkAudit audit(at(1));
  double x = 1;
  for (int n = 0; n < 1000; ++n) {
    x = std::nextafter(x, 2);
    audit.note(force(10), at(1), at(1), force(10), {at(x), {}}, 0);
    EXPECT_FALSE(audit.feeds()) << n;
  }
  EXPECT_GT(audit.made(), 0);
}

}  // namespace
}  // namespace toryu::coupling
