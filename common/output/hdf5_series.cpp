#include "common/output/hdf5_series.hpp"

#include <algorithm>
#include <stdexcept>

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
  const HdfHandle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), limit.data()), H5Sclose,
                        name);
  const HdfHandle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, 4);
  return {H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
          H5Dclose, name};
}

}  // namespace

HdfSeriesFile::HdfSeriesFile(std::filesystem::path path)
    : path_(std::move(path)),
      file_(H5Fcreate((path_.string() + ".part").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
            path_.string()) {}

HdfSeriesFile::~HdfSeriesFile() {
  series_.clear();
  // A full disk often shows only when the file is flushed; closing tells nothing of it.
  const bool whole = whole_ && H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0;
  { const HdfHandle closed = std::move(file_); }
  if (!whole) {
    log::error("{} could not be completed; what was written bears the name {}.part", path_.string(),
               path_.filename().string());
    return;
  }
  std::error_code failure;
  std::filesystem::rename(path_.string() + ".part", path_, failure);
  if (failure) log::error("{}: {}", path_.string(), failure.message());
}

void HdfSeriesFile::constant(const std::string& name, const std::string& unit, const Shape& shape,
                             std::span<const double> values) {
  constant(name, unit, H5T_NATIVE_DOUBLE, shape, values.data());
}

void HdfSeriesFile::constant(const std::string& name, const std::string& unit, const Shape& shape,
                             std::span<const std::uint32_t> values) {
  constant(name, unit, H5T_NATIVE_UINT32, shape, values.data());
}

void HdfSeriesFile::constant(const std::string& name, const std::string& unit, hid_t type, const Shape& shape,
                             const void* values) {
  const HdfHandle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                        name);
  const HdfHandle made(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose, name);
  H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  text_attribute(made, "unit", unit);
}

void HdfSeriesFile::attribute(const std::string& name, const std::string& key, const std::string& text) {
  const HdfHandle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  text_attribute(dataset, key, text);
}

void HdfSeriesFile::series(const std::string& name, const std::string& unit, const Shape& row_shape) {
  series_.push_back({name, row_shape, growing_dataset(file_, name, row_shape)});
  text_attribute(series_.back().dataset, "unit", unit);
}

void HdfSeriesFile::append(std::initializer_list<const double*> rows) {
  whole_ = false;
  auto row = rows.begin();
  for (const auto& series : series_) append(series, *row++);
  ++rows_;
  whole_ = true;
}

void HdfSeriesFile::append(const Series& series, const double* row) const {
  Shape size = series.shape, start(series.shape.size(), 0);
  size.insert(size.begin(), rows_ + 1);
  start.insert(start.begin(), rows_);
  Shape count = size;
  count[0] = 1;
  const auto fail = [&] {
    throw std::runtime_error(path_.filename().string() + ": cannot write " + series.name);
  };
  if (H5Dset_extent(series.dataset, size.data()) < 0) fail();
  const HdfHandle space(H5Dget_space(series.dataset), H5Sclose, series.name);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const HdfHandle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose,
                         series.name);
  if (H5Dwrite(series.dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, row) < 0) fail();
}

}  // namespace toryu
