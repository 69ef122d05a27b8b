/// What a participant leaves in the results folder: frames, series and a summary. Files are written under a
/// temporary name (`.part`) and renamed when complete. Each writer can say how far it is, with all of that on
/// the disk, and a later program can go on from there: what was written behind that point is taken back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "common/error/failure.hpp"
#include "common/run/provenance.hpp"
#include "common/run/solver.hpp"
#include "common/run/timers.hpp"

namespace toryu {

/// VTKHDF frames `frames/NAME_000123.hdf` with `NAME.hdf.series` beside the folder (rewritten at each frame).
class FrameWriter {
 public:
  struct State {
    std::vector<std::pair<std::string, double>> written;  ///< path and time [s] of each frame
  };

  FrameWriter(std::filesystem::path out, std::string name, Provenance provenance);
  /// The frame has its name soon after; throws MachineFailure for the one before, if it could not be
  /// completed.
  void write(double time, const Frame& frame);
  /// Waits until all frames have their names. Throws MachineFailure if one could not be completed.
  void complete();

  std::size_t count() const { return state_.written.size(); }
  /// All of its frames are on the disk. Throws as `complete` does.
  const State& state() {
    complete();
    return state_;
  }
  /// Goes on from `then`; later frames are removed.
  void resume(const State& then);

 private:
  std::filesystem::path list_path() const;
  std::string list_text() const;

  std::filesystem::path out_;
  std::string name_;
  Provenance provenance_;
  State state_;
  std::future<void> naming_;  // of the frame written last; waited for by its destructor
};

template <class Archive>
void serialize(Archive& archive, FrameWriter::State& state) {
  auto& [written] = state;
  archive(written);
}

/// `NAME.csv`: a row a call, `time[s]` first, then `name[unit]` columns fixed by the first row.
class SeriesWriter {
 public:
  struct State {
    std::vector<std::string> columns;
    std::uint64_t rows = 0;
  };

  SeriesWriter(const std::filesystem::path& out, const std::string& name);
  ~SeriesWriter();  ///< completes the file if nothing hinders
  void write(double time, const std::vector<Observation>& row);
  /// Gives the file its final name: no row follows. Throws MachineFailure if that fails.
  void complete();

  /// How far the series is; all of it is on the disk then. Throws MachineFailure if that fails.
  State state();
  /// Goes on from `then`: what the file holds beyond is cut off. Rows may have other columns from now on: new
  /// ones are `nan` in the rows before, and what is no longer observed is `nan` in the rows to come. The file
  /// may have got columns since `then`: they stay. Throws BadInput if the file is missing or shorter.
  void resume(const State& then);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

template <class Archive>
void serialize(Archive& archive, SeriesWriter::State& state) {
  auto& [columns, rows] = state;
  archive(columns, rows);
}

/// `NAME_summary.toml`: what ran, how long, where the time went, which terms were active.
struct Summary {
  std::string participant;  ///< "fluid", "solid", "coupler"
  Provenance provenance;
  ExitCode exit_code = ExitCode::done;
  std::string end_reason;  ///< why it ended, if not at the end
  double simulated_time = 0, wall_time = 0, waiting_time = 0, processor_time = 0;  // [s]
  long steps = 0;
  double smallest_time_step = 0, largest_time_step = 0;  // [s]
  std::string time_step_rule;
  std::vector<std::pair<std::string, long>> particles;  ///< "fluid": 8960, "wall tank_floor": 320
  std::vector<std::pair<std::string, double>>
      figures;  ///< other numbers worth keeping: "largest_impulse_error"
  std::vector<ActiveTerm> terms;
  std::vector<Timers::Part> parts;
};
void write_summary(const std::filesystem::path& out, const Summary& summary);

}  // namespace toryu
