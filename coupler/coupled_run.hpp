/// A coupled run, window after window: each is computed as the scheme of the case says (schemes.hpp), then
/// audited and recorded (coupled_record.hpp). Between two windows it writes checkpoints, and ends where it is
/// asked to stop.
#pragma once

#include <filesystem>
#include <optional>

#include "common/link/coupling_port.hpp"
#include "common/run/stop_file.hpp"
#include "common/run/timers.hpp"
#include "common/state/checkpoint.hpp"
#include "coupler/coupled_record.hpp"
#include "coupler/schemes.hpp"

namespace toryu::coupling {

/// Length [s] of the window that starts `left` [s] before the end of the run: at most `steps` fluid steps of
/// `limit` [s], and the last two windows alike rather than a whole one and a splinter.
double window_length(double left, int steps, double limit);

/// What a run does about checkpoints.
struct Checkpoints {
  double interval = 0, every = 0;          ///< of simulated and of wall time [s]; both 0: there are none
  std::optional<Checkpoint> restart = {};  ///< from which the run goes on
  std::string case_text = {};              ///< the case as all three use it
  bool wanted() const { return interval > 0 || every > 0; }
};

class CoupledRun {
 public:
  CoupledRun(Settings settings, CouplingPort& port)
      : settings_(std::move(settings)), port_(port), stop_(settings_.out) {}

  /// Runs all windows to the end. Throws Interrupted, after a last checkpoint, if it is asked to stop by a
  /// signal to any of the processes or by the file `stop`.
  void run(const CouplingStart& start, const Checkpoints& checkpoints = {});
  /// Writes the last state, and gives the results their final names. Throws MachineFailure if that fails.
  void complete();
  /// Writes the last state, of a run that ended before its time too.
  void write_last();
  /// Whether a window was computed, or a checkpoint read.
  bool has_begun() const { return state_.window.number > 0; }
  /// Adds what is known of the run so far, to a summary that has the times of this process already.
  void report(Summary& summary) const;

  struct State {
    double time = 0, time_step_limit = 0;                        ///< [s]
    Window window;                                               ///< the last one
    double wall_time = 0, processor_time = 0, waiting_time = 0;  ///< before the restart [s]
    std::vector<Timers::Part> parts;                             ///< of that time
  };

 private:
  void advance();
  void read_state(const std::filesystem::path& folder);
  void write_state(std::ostream& stream);
  double wall_time() const;
  double waiting_time() const;
  void write_checkpoint();
  std::string let_participants_write(const std::filesystem::path& folder);
  void stop_if_asked();

  using Clock = std::chrono::steady_clock;
  Settings settings_;
  CouplingPort& port_;
  Checkpoints checkpoints_;
  CheckpointSchedule checkpoints_due_{0, 0};
  std::filesystem::path checkpoint_;  // that of the last window, in the results; empty if there is none
  std::filesystem::path opened_;      // the last that was begun
  StopFile stop_;
  Timers timers_;
  State state_;
  std::unique_ptr<Scheme> scheme_;
  std::optional<CoupledRecord> record_;
  std::optional<Exchange> last_;  // of the window computed last
  Window last_window_;
  Clock::time_point start_ = Clock::now();
};

template <class Archive>
void serialize(Archive& archive, CoupledRun::State& state) {
  auto& [time, time_step_limit, window, wall_time, processor_time, waiting_time, parts] = state;
  archive(time, time_step_limit, window, wall_time, processor_time, waiting_time, parts);
}

}  // namespace toryu::coupling
