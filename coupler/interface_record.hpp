/// `interface.h5`: what crossed the interface over time, for replay and for study. Positions and velocities
/// [m, m/s] are at `time` [s]; pressure [Pa] and forces [N/m] are those of the window
/// that ended then (zero in the first row). The file is made at the end of the run (hdf5_series.hpp).
#pragma once

#include <filesystem>

#include "common/link/participant.hpp"
#include "common/output/hdf5_series.hpp"

namespace toryu::coupling {

class InterfaceRecord {
 public:
  InterfaceRecord(const std::filesystem::path& out, const Interface& interface);

  /// Appends a row. `load` is what the solid applied.
  void write(double time, const InterfaceMotion& motion, const InterfaceLoad& load);

  /// Gives the file its final name: no row follows.
  void complete() { file_.complete(); }

  using State = HdfSeriesFile::State;
  State state() { return file_.state(); }
  void resume(const State& then) { file_.resume(then); }

 private:
  HdfSeriesFile file_;
};

}  // namespace toryu::coupling
