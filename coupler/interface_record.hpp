/// `interface.h5`: what crossed the interface over time, for replay and for study. Positions and velocities
/// [m, m/s] are at `time` [s]; pressure [Pa] and forces [N/m] are those of the window
/// that ended then (zero in the first row). The file is written as `interface.h5.part` and renamed at the
/// end, if all of it could be written.
#pragma once

#include <filesystem>
#include <memory>

#include "common/link/participant.hpp"

namespace toryu {
class HdfSeriesFile;
}

namespace toryu::coupling {

class InterfaceRecord {
 public:
  InterfaceRecord(const std::filesystem::path& out, const Interface& interface);
  ~InterfaceRecord();  ///< gives the file its final name, unless a write failed

  /// Appends a row. `load` is what the solid applied.
  void write(double time, const InterfaceMotion& motion, const InterfaceLoad& load);

 private:
  std::unique_ptr<HdfSeriesFile> file_;
};

}  // namespace toryu::coupling
