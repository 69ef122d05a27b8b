#include "common/output/hdf5_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/output/atomic_file.hpp"
#include "common/output/hdf5_reader.hpp"
#include "common/run/log.hpp"

namespace toryu {

namespace {

constexpr hsize_t rows_per_chunk = 16;

void text_attribute(hid_t object, const std::string& name, const std::string& text) {
  const HdfHandle type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  const HdfHandle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const HdfHandle made(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                       name);
  H5Awrite(made, type, text.data());
}

HdfHandle growing_dataset(hid_t file, const std::string& name, const HdfSeriesFile::Shape& row_shape) {
  auto size = row_shape, limit = row_shape, chunk = row_shape;
  size.insert(size.begin(), 0);
  limit.insert(limit.begin(), H5S_UNLIMITED);
  chunk.insert(chunk.begin(), rows_per_chunk);
  for (auto* shape : {&limit, &chunk})  // HDF5 knows no chunk of nothing, which rows without a point would be
    for (auto& length : *shape) length = std::max<hsize_t>(length, 1);
  const HdfHandle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), limit.data()), H5Sclose,
                        name);
  const HdfHandle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  H5Pset_obj_track_times(properties, false);  // equal runs give equal files
  H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, 4);
  return {H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
          H5Dclose, name};
}

void write_constant(hid_t file, const std::string& name, hid_t type, const HdfSeriesFile::Shape& shape,
                    const void* values, const std::string& unit,
                    const std::vector<std::pair<std::string, std::string>>& attributes) {
  const HdfHandle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                        name);
  const HdfHandle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  H5Pset_obj_track_times(properties, false);
  const HdfHandle made(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                       H5Dclose, name);
  H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  text_attribute(made, "unit", unit);
  for (const auto& [key, text] : attributes) text_attribute(made, key, text);
}

/// Writes row number `row` of a series.
bool write_row(const HdfHandle& dataset, const HdfSeriesFile::Shape& row_shape, hsize_t row,
               const double* values) {
  HdfSeriesFile::Shape start(row_shape.size(), 0), count = row_shape;
  start.insert(start.begin(), row);
  count.insert(count.begin(), 1);
  const HdfHandle space(H5Dget_space(dataset), H5Sclose, "row");
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const HdfHandle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose,
                         "row");
  return H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values) >= 0;
}

}  // namespace

std::size_t HdfSeriesFile::Series::size() const {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1},
                         [](std::size_t product, hsize_t side) { return product * side; });
}

std::size_t HdfSeriesFile::row_size() const {
  std::size_t sum = 0;
  for (const auto& series : series_) sum += series.size();
  return sum * sizeof(double);
}

HdfSeriesFile::~HdfSeriesFile() {
  try {
    complete();
  } catch (const std::exception& reason) {  // of a run that failed for another reason
    log::error("{}; its rows are in {}", reason.what(), rows_path().filename().string());
  }
}

void HdfSeriesFile::complete() {
  if (!spool_) return;  // nothing was written, and what an earlier run left stays
  const bool whole = std::fclose(std::exchange(spool_, nullptr)) == 0;
  const int reason = errno;
  std::ifstream rows(rows_path(), std::ios::binary);
  if (!rows) throw MachineFailure(fmt::format("cannot complete '{}'", path_.string()), errno);
  std::error_code ignored;
  try {
    write_all(rows);
    give_name(path_);
  } catch (...) {
    std::filesystem::remove(part_of(path_), ignored);  // of no use, and where the disk is full in the way
    throw;
  }
  std::filesystem::remove(rows_path(), ignored);
  if (!whole) fail_to_write(rows_path(), reason);
}

/// The file from what is known of it and its rows, as many as are whole.
void HdfSeriesFile::write_all(std::ifstream& rows) const {
  const std::string writing = fmt::format("write '{}'", part_of(path_).string());
  const HdfHandle file(H5Fcreate(part_of(path_).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                       writing);
  for (const auto& c : constants_)
    write_constant(file, c.name, c.numbers.empty() ? H5T_NATIVE_UINT32 : H5T_NATIVE_DOUBLE, c.shape,
                   c.numbers.empty() ? static_cast<const void*>(c.integers.data()) : c.numbers.data(), c.unit,
                   c.attributes);
  std::vector<HdfHandle> datasets;
  for (const auto& series : series_) {
    datasets.push_back(growing_dataset(file, series.name, series.shape));
    text_attribute(datasets.back(), "unit", series.unit);
  }
  std::vector<double> row(row_size() / sizeof(double));
  for (hsize_t n = 0; n < state_.rows; ++n) {
    rows.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row_size()));
    if (!rows) throw std::runtime_error(fmt::format("row {} cannot be read", n));
    const double* values = row.data();
    for (std::size_t k = 0; k < series_.size(); values += series_[k++].size()) {
      auto size = series_[k].shape;
      size.insert(size.begin(), n + 1);
      const bool written =
          H5Dset_extent(datasets[k], size.data()) >= 0 && write_row(datasets[k], series_[k].shape, n, values);
      hdf5_must(written, writing);
    }
  }
  datasets.clear();
  // A full disk often shows only when the file is flushed; closing tells nothing of it.
  hdf5_must(H5Fflush(file, H5F_SCOPE_LOCAL) >= 0, writing);
}

void HdfSeriesFile::constant(const std::string& name, const std::string& unit, const Shape& shape,
                             std::span<const double> values) {
  constants_.push_back({name, unit, shape, {values.begin(), values.end()}, {}, {}});
}

void HdfSeriesFile::constant(const std::string& name, const std::string& unit, const Shape& shape,
                             std::span<const std::uint32_t> values) {
  constants_.push_back({name, unit, shape, {}, {values.begin(), values.end()}, {}});
}

void HdfSeriesFile::attribute(const std::string& name, const std::string& key, const std::string& text) {
  for (auto& constant : constants_)
    if (constant.name == name) constant.attributes.emplace_back(key, text);
}

void HdfSeriesFile::series(const std::string& name, const std::string& unit, const Shape& row_shape) {
  series_.push_back({name, unit, row_shape});
}

void HdfSeriesFile::append(const std::vector<const double*>& rows) {
  const auto fail = [&] { fail_to_write(rows_path(), errno); };
  if (!spool_ && !(spool_ = std::fopen(rows_path().c_str(), "wb"))) fail();
  auto row = rows.begin();
  for (const auto& series : series_)
    if (std::fwrite(*row++, sizeof(double), series.size(), spool_) != series.size()) fail();
  if (std::fflush(spool_) != 0) fail();
  ++state_.rows;
}

HdfSeriesFile::State HdfSeriesFile::state() {
  if (spool_) synchronise(rows_path());
  return state_;
}

void HdfSeriesFile::resume(const State& then) {
  if (then.rows == 0) return;
  const auto wanted = then.rows * row_size();
  std::error_code failure;
  auto size = std::filesystem::file_size(rows_path(), failure);
  // Rows that are too few are left of a restart that did not get beyond reading them back.
  if (failure || (size < wanted && std::filesystem::exists(path_))) {
    read_back(then.rows);
    size = std::filesystem::file_size(rows_path(), failure);
  }
  if (failure || size < wanted)
    throw BadInput(
        {{.place = rows_path().string(),
          .message = fmt::format("cannot go on: {}", failure ? failure.message() : "rows are missing")}});
  std::filesystem::resize_file(rows_path(), wanted);
  spool_ = std::fopen(rows_path().c_str(), "ab");
  if (!spool_) throw BadInput({{.place = rows_path().string(), .message = std::strerror(errno)}});
  state_ = then;
}

/// The rows of a file that was completed.
void HdfSeriesFile::read_back(std::uint64_t rows) const {
  try {
    HdfReader file(path_);
    std::ofstream spool(rows_path(), std::ios::binary | std::ios::trunc);
    for (std::size_t n = 0; n < rows; ++n)
      for (const auto& series : series_) {
        const auto row = file.row(series.name, n);
        spool.write(reinterpret_cast<const char*>(row.data()),
                    static_cast<std::streamsize>(row.size() * sizeof(double)));
      }
    spool.close();
    if (!spool) fail_to_write(rows_path(), errno);
  } catch (const BadInput& fault) {
    std::error_code ignored;
    std::filesystem::remove(rows_path(), ignored);
    throw BadInput({{.place = path_.string(), .message = "cannot go on: " + fault.errors().front().message}});
  }
}

}  // namespace toryu
