/// When something that happens every so often is due.
#pragma once

#include <cmath>
#include <limits>

namespace toryu {

/// Times k * interval, k = `first`, `first` + 1, ...; never if the interval is 0.
class Schedule {
 public:
  struct State {
    double interval = 0;
    long count = 0;
  };

  explicit Schedule(double interval, long first = 0) : state_{interval, first} {}
  double next() const {
    return state_.interval > 0 ? static_cast<double>(state_.count) * state_.interval
                               : std::numeric_limits<double>::infinity();
  }
  /// Whether `time` has reached the next time; goes on to the one after it.
  bool reached(double time) {
    if (time < next() - 1e-9 * state_.interval) return false;
    state_.count = count_at(time);
    return true;
  }

  const State& state() const { return state_; }
  /// Goes on at `time` where a schedule was in the state `then`; with another interval by the time alone.
  void resume(const State& then, double time) {
    if (state_.interval > 0) state_.count = then.interval == state_.interval ? then.count : count_at(time);
  }

 private:
  /// Of the first time behind `time`.
  long count_at(double time) const {
    return static_cast<long>(std::floor(time / state_.interval + 1e-9)) + 1;
  }
  State state_;
};

template <class Archive>
void serialize(Archive& archive, Schedule::State& state) {
  auto& [interval, count] = state;
  archive(interval, count);
}

}  // namespace toryu
