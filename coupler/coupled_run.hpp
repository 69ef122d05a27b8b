/// A coupled run, window after window: each is computed as the scheme of the case says (schemes.hpp), then
/// audited and recorded (coupled_record.hpp).
#pragma once

#include <optional>

#include "common/link/coupling_port.hpp"
#include "common/run/timers.hpp"
#include "coupler/coupled_record.hpp"
#include "coupler/schemes.hpp"

namespace toryu::coupling {

/// Length [s] of the window that starts `left` [s] before the end of the run: at most `steps` fluid steps of
/// `limit` [s], and the last two windows alike rather than a whole one and a splinter.
double window_length(double left, int steps, double limit);

class CoupledRun {
 public:
  CoupledRun(Settings settings, CouplingPort& port) : settings_(std::move(settings)), port_(port) {}

  /// Runs all windows to the end.
  void run(const CouplingStart& start);
  /// What is known of the run so far; the wall time must be in the summary already.
  void report(Summary& summary) const;

  struct State {
    double time = 0, time_step_limit = 0;  ///< [s]
    Window window;                         ///< the last one
  };

 private:
  void advance();

  Settings settings_;
  CouplingPort& port_;
  Timers timers_;
  State state_;
  std::unique_ptr<Scheme> scheme_;
  std::optional<CoupledRecord> record_;
};

template <class Archive>
void serialize(Archive& archive, CoupledRun::State& state) {
  auto& [time, time_step_limit, window] = state;
  archive(time, time_step_limit, window);
}

}  // namespace toryu::coupling
