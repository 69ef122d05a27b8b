/// An HDF5 file of a run: datasets known at the start, and series that gain a row at a time. A program that
/// is killed may leave an HDF5 file that cannot be read, so rows go to `PATH.rows.part` one after the other
/// first. The file is made of them by `complete`, or at the end of its life however the run ended, as
/// `PATH.part`, and gets its name when it is complete; then the rows are removed. A later program can go on
/// from any row. Without a row there is no file, and one that is there stays.
#pragma once

#include <cstdio>
#include <vector>

#include "common/output/hdf5_file.hpp"

namespace toryu {

class HdfSeriesFile {
 public:
  using Shape = std::vector<hsize_t>;
  struct State {
    std::uint64_t rows = 0;
  };

  explicit HdfSeriesFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~HdfSeriesFile();
  HdfSeriesFile(const HdfSeriesFile&) = delete;
  HdfSeriesFile& operator=(const HdfSeriesFile&) = delete;

  /// A dataset that is known at the start, its attribute `unit` beside it.
  void constant(const std::string& name, const std::string& unit, const Shape& shape,
                std::span<const double> values);
  void constant(const std::string& name, const std::string& unit, const Shape& shape,
                std::span<const std::uint32_t> values);
  /// A text attribute of a constant.
  void attribute(const std::string& name, const std::string& key, const std::string& text);
  /// A series of rows of one shape ({} for a number).
  void series(const std::string& name, const std::string& unit, const Shape& row_shape);
  /// Adds a row to each series, in the order in which they were made. Throws MachineFailure, naming the
  /// file, if it cannot be written.
  void append(const std::vector<const double*>& rows);
  /// Makes the file of its rows: none follows. Throws MachineFailure if that fails; the rows stay then.
  void complete();

  /// How far the series are; all of it is on the disk then. Throws MachineFailure if that fails.
  State state();
  /// Goes on from `then`: rows beyond are cut off. Throws BadInput if they are missing.
  void resume(const State& then);

 private:
  struct Constant {
    std::string name, unit;
    Shape shape;
    std::vector<double> numbers;
    std::vector<std::uint32_t> integers;                          ///< if there are no numbers
    std::vector<std::pair<std::string, std::string>> attributes;  ///< beside the unit
  };
  struct Series {
    std::string name, unit;
    Shape shape;
    std::size_t size() const;  ///< numbers of a row
  };
  std::filesystem::path rows_path() const { return path_.string() + ".rows.part"; }
  std::size_t row_size() const;
  void write_all(std::ifstream& rows) const;
  void read_back(std::uint64_t rows) const;

  std::filesystem::path path_;
  std::vector<Constant> constants_;
  std::vector<Series> series_;
  std::FILE* spool_ = nullptr;  ///< where the rows go, once there is one
  State state_;
};

template <class Archive>
void serialize(Archive& archive, HdfSeriesFile::State& state) {
  auto& [rows] = state;
  archive(rows);
}

}  // namespace toryu
