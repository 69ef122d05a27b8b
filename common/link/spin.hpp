/// How long a wait looks for news before it sleeps. To wake a core that has gone idle takes longer than a
/// message, on a virtual machine most of all, so a short wait is better spent awake; a long one belongs to
/// whoever computes. Which it will be is told by the waits before it. A wait that spins offers its core to
/// others all the time; where one takes it, spinning costs more than it saves, and ceases for a while.
#pragma once

#include <chrono>
#include <thread>

namespace toryu {

class Spin {
 public:
  using Duration = std::chrono::nanoseconds;
  /// No wait spins longer.
  static constexpr Duration longest = std::chrono::microseconds(400);

  /// For how long the next wait is to spin, at a time `now` since any start.
  Duration budget(Duration now) const;
  /// Takes note of a wait that ended at `now`: how long it was, and how long it spun by the clock and by the
  /// processor.
  void note(Duration now, Duration waited, Duration spun, Duration processor);

 private:
  Duration expected_{0};  // mean of recent waits
  Duration pause_{0};     // after the core was taken away; longer each time
  Duration pause_ends_{0};
};

/// A wait that may spin, from its beginning to its end.
class SpinningWait {
 public:
  explicit SpinningWait(Spin& spin) : spin_(spin), end_of_spin_(begin_ + spin.budget(begin_)) {}
  ~SpinningWait() { spin_.note(clock(), clock() - begin_, spun_, processor_); }
  SpinningWait(const SpinningWait&) = delete;
  SpinningWait& operator=(const SpinningWait&) = delete;

  /// Looks for news until there are some or it is time to sleep; returns whether there are.
  template <class News>
  bool look(News&& news) {
    const auto begin = clock();
    if (begin >= end_of_spin_) return false;
    const auto processor = processor_time();
    bool there = false;
    while (!(there = news()) && clock() < end_of_spin_) std::this_thread::yield();
    spun_ += clock() - begin;
    processor_ += processor_time() - processor;
    return there;
  }

 private:
  static Spin::Duration clock() { return std::chrono::steady_clock::now().time_since_epoch(); }
  static Spin::Duration processor_time();  // of this thread

  Spin& spin_;
  const Spin::Duration begin_ = clock(), end_of_spin_;
  Spin::Duration spun_{0}, processor_{0};
};

}  // namespace toryu
