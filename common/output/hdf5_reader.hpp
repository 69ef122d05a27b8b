/// Reads HDF5 files of runs that have ended.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/output/hdf5_file.hpp"

namespace toryu {

/// A file with datasets of numbers; whatever is wrong with it is BadInput that names it.
class HdfReader {
 public:
  explicit HdfReader(std::filesystem::path path);

  /// All numbers of a dataset.
  std::vector<double> all(const std::string& name);
  /// The rows of a dataset: the first of its dimensions.
  std::size_t rows(const std::string& name);
  /// The numbers of one row.
  std::vector<double> row(const std::string& name, std::size_t number);

 private:
  struct Dataset {
    HdfHandle handle;
    std::vector<hsize_t> shape;
    std::size_t size_of_row() const;
  };
  [[noreturn]] void fail(const std::string& why) const;
  const Dataset& dataset(const std::string& name);

  std::filesystem::path path_;
  HdfHandle file_;
  std::map<std::string, Dataset> datasets_;
};

}  // namespace toryu
