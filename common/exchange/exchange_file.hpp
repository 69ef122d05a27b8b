/// `exchange.h5`: all that the fluid and the solid of a coupled run answered, window by window, so that
/// either side can be run again against what the other one said.
#pragma once

#include <filesystem>

#include "common/link/coupling_port.hpp"
#include "common/output/hdf5_reader.hpp"
#include "common/output/hdf5_series.hpp"

namespace toryu {

/// What a window brought, of an implicit scheme in the iteration that counts. Of the window there are start
/// and length, of both sides' health the energies and the momentum.
struct RecordedWindow {
  Window window;
  FluidAnswer fluid;
  SolidAnswer solid;
};

class ExchangeWriter {
 public:
  ExchangeWriter(const std::filesystem::path& out, const CouplingStart& start);

  /// Adds a window. Throws MachineFailure, naming the file, if it cannot be written.
  void write(const Window& window, const FluidAnswer& fluid, const SolidAnswer& solid);
  /// Gives the file its final name: no window follows.
  void complete() { file_.complete(); }

  using State = HdfSeriesFile::State;
  State state() { return file_.state(); }
  void resume(const State& then) { file_.resume(then); }

 private:
  std::vector<double> none_;  ///< in the place of what an answer is without
  HdfSeriesFile file_;
};

/// Whatever is wrong with the file is BadInput that names it.
class ExchangeReader {
 public:
  explicit ExchangeReader(const std::filesystem::path& out);

  const std::filesystem::path& path() const { return path_; }
  const CouplingStart& start() const { return start_; }
  std::size_t size() const { return ends_.size(); }
  double end() const { return ends_.back(); }  ///< of the last window [s]
  /// The number of the window in which `time` [s] lies; one that ends then counts as before it.
  std::size_t at(double time) const;
  /// The last few that were asked for are kept.
  const RecordedWindow& window(std::size_t number);

 private:
  [[noreturn]] void refuse(const std::string& why) const;
  void check_windows();
  RecordedWindow read(std::size_t number);

  std::filesystem::path path_;
  HdfReader file_;
  CouplingStart start_;
  std::vector<double> starts_, lengths_, ends_;  ///< of the windows [s]
  std::vector<std::pair<std::size_t, RecordedWindow>> kept_;
};

}  // namespace toryu
