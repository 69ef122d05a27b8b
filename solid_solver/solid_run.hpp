/// What a run of the solid leaves behind, alone or coupled: frames and series at their intervals, and at the
/// end a summary, whatever the end is.
#pragma once

#include <chrono>
#include <limits>

#include "common/output/results.hpp"
#include "common/scene/scene.hpp"
#include "solid_solver/solid_model.hpp"

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

/// Equal steps over some length of time.
struct SubSteps {
  long taken, needed;
  double dt;  ///< [s]
};

class SolidRun {
 public:
  SolidRun(const Options& options, const Scene& scene, SolidModel& model);

  /// Checks the state at `time` [s], and writes what is due.
  void at(double time);
  /// Advances by `length` [s] in equal sub-steps, as few as stability allows, and takes at most `most` of
  /// them.
  SubSteps advance(double length, long most = std::numeric_limits<long>::max());
  SolidModel& model() { return model_; }
  bool writes_every_step() const { return every_step_; }
  /// The next time at which something is due [s].
  double next_output() const { return std::min(frames_due_.next(), series_due_.next()); }
  long steps() const { return summary_.steps; }
  void finish(ExitCode code, const std::string& last_words, double waiting_time);

 private:
  using Clock = std::chrono::steady_clock;
  SolidModel& model_;
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
