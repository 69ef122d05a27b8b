/// What a run of a solver leaves behind, alone or coupled: frames and series at their intervals, and at the
/// end a summary, whatever the end is. It also writes the participant's part of a checkpoint and goes on from
/// one.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "common/loop/schedule.hpp"
#include "common/output/results.hpp"
#include "common/run/options.hpp"
#include "common/run/solver.hpp"
#include "common/scene/scene.hpp"
#include "common/state/checkpoint.hpp"

namespace toryu {

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
  /// Writes a row and, where frames are wanted, a frame of the state that was checked last, whether it passed
  /// or not, if there is none yet: the last state of a run is always there. A checkpoint that was written
  /// before does not know of them, and a run that goes on from it replaces them.
  void write_last();
  /// The same at the end of a run that went well; lets the solver look at a row that was still to be written.
  void write_end();
  /// Counts sub-steps of length `dt` [s].
  void count_steps(long steps, double dt);
  /// The next time at which something is due [s].
  double next_output() const { return std::min(frames_due_.next(), series_due_.next()); }
  long steps() const { return state_.steps; }
  double wall_time() const;  ///< since the start of the run, the time before a restart included [s]

  /// Writes this participant's part of a checkpoint, `participant`.state in `folder`, for the state that was
  /// written last. Throws MachineFailure if that fails.
  void write_checkpoint(const std::filesystem::path& folder);
  /// Goes on from that part: solver, series, frames and counts. To be called before anything is written.
  /// Throws BadInput if the part is of another program or damaged, or if results are missing.
  void read_checkpoint(const std::filesystem::path& folder);
  const std::string& participant() const { return participant_; }
  /// Who writes the participant's part of a checkpoint, and alone can go on from it; without it, the solver.
  void made_by(const Author& author) { author_ = author; }
  /// Time of the state that was written last [s].
  double time() const { return state_.time; }

  /// How to ask for the time spent waiting for partners since the start of the program [s]; without it, none.
  void measure_waiting(std::function<double()> waited) { waited_ = std::move(waited); }
  /// Gives the files that grew during the run their final names. Throws MachineFailure if that fails.
  void complete();
  /// Writes the summary. Where a run was to go on and could not, that of the run before stays.
  void finish(ExitCode code, const std::string& end_reason);

 private:
  using Clock = std::chrono::steady_clock;
  /// What a restart takes over.
  struct State {
    double time = 0;  ///< of the last state that was written [s]
    long steps = 0;
    double smallest_time_step = std::numeric_limits<double>::infinity(), largest_time_step = 0;  ///< [s]
    double wall_time = 0, processor_time = 0, waiting_time = 0;  ///< before the restart [s]
    std::vector<Timers::Part> parts;                             ///< of that time
    Schedule::State frames_due, series_due;
    SeriesWriter::State series;
    FrameWriter::State frames, walls;
  };
  template <class Archive>
  friend void serialize(Archive& archive, State& state) {
    auto& [time, steps, smallest, largest, wall, processor, waiting, parts, frames_due, series_due, series,
           frames, walls] = state;
    archive(time, steps, smallest, largest, wall, processor, waiting, parts, frames_due, series_due, series,
            frames, walls);
  }
  double waiting_time() const { return state_.waiting_time + (waited_ ? waited_() : 0); }
  std::vector<Timers::Part> parts() const;
  void write_row(double time);
  void write_frame(double time);

  std::string participant_;
  Author author_;
  Solver& solver_;
  const Timers& solver_timers_;
  std::filesystem::path out_;
  FrameWriter frames_;
  std::optional<FrameWriter> walls_;  ///< of a solver that has some
  SeriesWriter series_;
  Schedule frames_due_, series_due_;
  bool every_step_;
  bool to_be_resumed_;
  std::function<double()> waited_;
  std::optional<double> reached_;                      ///< time of the state that was checked last [s]
  std::optional<double> row_written_, frame_written_;  ///< times of the last ones of this program [s]
  State state_;
  Summary summary_;
  Timers timers_;
  Clock::time_point start_ = Clock::now();
};

/// Writes the particles of a solver at the start, and its walls, as frames into `folder`; nothing if that is
/// empty. Throws MachineFailure if they cannot be written.
void write_start(const std::filesystem::path& folder, const std::string& participant, const Solver& solver);

}  // namespace toryu
