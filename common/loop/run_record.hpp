/// What a run of a solver leaves behind, alone or coupled: frames and series at their intervals, and at the
/// end a summary, whatever the end is.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "common/output/results.hpp"
#include "common/run/options.hpp"
#include "common/run/solver.hpp"
#include "common/scene/scene.hpp"

namespace toryu {

/// Times k * interval, k = 0, 1, ...; never if the interval is 0.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}
  double next() const {
    return interval_ > 0 ? static_cast<double>(count_) * interval_ : std::numeric_limits<double>::infinity();
  }
  /// Whether `time` has reached the next time; goes on to the one after it.
  bool reached(double time);

 private:
  double interval_;
  long count_ = 0;
};

class RunRecord {
 public:
  using Counts = std::vector<std::pair<std::string, long>>;
  /// `participant` is "fluid" or "solid"; `counts` says how many particles each body holds; `timers` are the
  /// solver's own.
  RunRecord(const std::string& participant, const Options& options, const Scene& scene, Solver& solver,
            const Counts& counts, const Timers& timers);

  /// Checks the state at `time` [s].
  void check(double time);
  /// Takes the state at `time` [s], which was checked, as final and writes what is due.
  void write(double time);
  void check_and_write(double time) {
    check(time);
    write(time);
  }
  /// Counts sub-steps of length `dt` [s].
  void count_steps(long steps, double dt);
  /// The next time at which something is due [s].
  double next_output() const { return std::min(frames_due_.next(), series_due_.next()); }
  long steps() const { return summary_.steps; }
  /// Writes the summary.
  void finish(ExitCode code, const std::string& last_words, double waiting_time);

 private:
  using Clock = std::chrono::steady_clock;
  Solver& solver_;
  const Timers& solver_timers_;
  std::filesystem::path out_;
  FrameWriter frames_;
  SeriesWriter series_;
  Schedule frames_due_, series_due_;
  bool every_step_;
  Summary summary_;
  Timers timers_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace toryu
