#include "common/link/spin.hpp"

#include <algorithm>
#include <ctime>

namespace toryu {

namespace {

using namespace std::chrono_literals;

constexpr int remembered = 8;              // waits in the mean, about
constexpr int good_waits_to_forget = 256;  // a pause, by and by: who took the core once may come again
/// The threads of a run share a core for some tens of microseconds; another program takes it for
/// milliseconds.
constexpr Spin::Duration longest_of_peers = 500us;
constexpr Spin::Duration shortest_pause = 100ms, longest_pause = 2s;

/// A wait counts as so long at most: a single checkpoint must not spoil the mean.
constexpr Spin::Duration longest_counted = 2 * Spin::longest;

}  // namespace

Spin::Duration Spin::budget(Duration now) const {
  if (now < pause_ends_ || expected_ > longest) return Duration{0};
  return std::clamp(2 * expected_, longest / 8, longest);
}

void Spin::note(Duration now, Duration waited, Duration spun, Duration processor) {
  expected_ += (std::min(waited, longest_counted) - expected_) / remembered;
  if (spun == Duration{0}) return;
  const bool alone = spun - processor < longest_of_peers;
  pause_ =
      alone ? pause_ - pause_ / good_waits_to_forget : std::clamp(2 * pause_, shortest_pause, longest_pause);
  if (!alone) pause_ends_ = now + pause_;
}

Spin::Duration SpinningWait::processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace toryu
