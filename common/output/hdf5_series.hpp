/// An HDF5 file that grows with a run: datasets known at the start, and series that gain a row at a time. It
/// is written as `PATH.part` and gets its name at the end of its life, however the run ended, if every row
/// that was begun is complete.
#pragma once

#include <initializer_list>
#include <vector>

#include "common/output/hdf5_file.hpp"

namespace toryu {

class HdfSeriesFile {
 public:
  using Shape = std::vector<hsize_t>;

  explicit HdfSeriesFile(std::filesystem::path path);
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
  /// Adds a row to each series, in the order in which they were made. Throws std::runtime_error, naming the
  /// file and the series, if it cannot be written.
  void append(std::initializer_list<const double*> rows);

 private:
  struct Series {
    std::string name;
    Shape shape;
    HdfHandle dataset;
  };
  void constant(const std::string& name, const std::string& unit, hid_t type, const Shape& shape,
                const void* values);
  void append(const Series& series, const double* row) const;

  std::filesystem::path path_;
  HdfHandle file_;
  std::vector<Series> series_;
  hsize_t rows_ = 0;
  bool whole_ = true;  ///< all rows that were begun are complete
};

}  // namespace toryu
