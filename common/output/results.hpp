/// What a participant leaves in the results folder: frames, series and a summary. Files are written under a
/// temporary name (`.part`) and renamed when complete.
#pragma once

#include <filesystem>
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
  FrameWriter(std::filesystem::path out, std::string name, Provenance provenance);
  void write(double time, const Frame& frame);

 private:
  std::filesystem::path out_;
  std::string name_;
  Provenance provenance_;
  std::vector<std::pair<std::string, double>> written_;
};

/// `NAME.csv`: a row a call, `time[s]` first, then `name[unit]` columns fixed by the first row.
class SeriesWriter {
 public:
  SeriesWriter(const std::filesystem::path& out, const std::string& name);
  ~SeriesWriter();  ///< gives the file its final name
  void write(double time, const std::vector<Observation>& row);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// `NAME_summary.toml`: what ran, how long, where the time went, which terms were active.
struct Summary {
  std::string participant;  ///< "fluid", "solid", "coupler"
  Provenance provenance;
  ExitCode exit_code = ExitCode::done;
  std::string last_words;  ///< why it ended, if not at the end
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
