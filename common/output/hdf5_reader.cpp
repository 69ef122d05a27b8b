#include "common/output/hdf5_reader.hpp"

#include <fmt/format.h>

#include <cstring>
#include <numeric>
#include <utility>

#include "common/error/counted.hpp"
#include "common/error/failure.hpp"

namespace toryu {

namespace {

/// A chunk of a wide row exceeds the library's cache, and would be unpacked anew for each of its rows.
constexpr std::size_t cache_of_dataset = 16u << 20;  // [bytes]
constexpr std::size_t slots_of_cache = 521;
constexpr double first_out = 1.0;  // chunks that have been read whole

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw BadInput({{.place = path.string(), .message = why}});
}

HdfHandle opened(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) refuse(path, "there is no such file");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) refuse(path, "it is no HDF5 file, or not whole");
  return {file, H5Fclose, "read it"};
}

}  // namespace

HdfReader::HdfReader(std::filesystem::path path) : path_(std::move(path)), file_(opened(path_)) {}

void HdfReader::fail(const std::string& why) const {
  refuse(path_, why);
}

std::size_t HdfReader::Dataset::size_of_row() const {
  return std::accumulate(shape.begin() + 1, shape.end(), std::size_t{1},
                         [](std::size_t product, hsize_t side) { return product * side; });
}

const HdfReader::Dataset& HdfReader::dataset(const std::string& name) {
  if (const auto found = datasets_.find(name); found != datasets_.end()) return found->second;
  if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) fail(fmt::format("it has no '{}'", name));
  const HdfHandle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, name);
  H5Pset_chunk_cache(access, slots_of_cache, cache_of_dataset, first_out);
  const hid_t made = H5Dopen2(file_, name.c_str(), access);
  if (made < 0) fail(fmt::format("'{}' in it is no dataset", name));
  Dataset dataset{{made, H5Dclose, name}, {}};
  const HdfHandle space(H5Dget_space(dataset.handle), H5Sclose, name);
  dataset.shape.resize(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
  if (dataset.shape.empty()) fail(fmt::format("'{}' in it has no rows", name));
  H5Sget_simple_extent_dims(space, dataset.shape.data(), nullptr);
  return datasets_.emplace(name, std::move(dataset)).first->second;
}

std::size_t HdfReader::rows(const std::string& name) {
  return dataset(name).shape[0];
}

std::vector<double> HdfReader::all(const std::string& name) {
  const Dataset& from = dataset(name);
  std::vector<double> values(from.shape[0] * from.size_of_row());
  if (H5Dread(from.handle, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(fmt::format("'{}' in it cannot be read", name));
  return values;
}

std::vector<double> HdfReader::row(const std::string& name, std::size_t number) {
  const Dataset& from = dataset(name);
  if (number >= from.shape[0])
    fail(fmt::format("'{}' in it has no more than {}", name, counted(from.shape[0], "row")));
  std::vector<hsize_t> start(from.shape.size(), 0), count = from.shape;
  start[0] = number;
  count[0] = 1;
  const HdfHandle space(H5Dget_space(from.handle), H5Sclose, name);
  const HdfHandle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose,
                         name);
  std::vector<double> values(from.size_of_row());
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
      H5Dread(from.handle, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) < 0)
    fail(fmt::format("row {} of '{}' in it cannot be read", number, name));
  return values;
}

}  // namespace toryu
