#include "common/output/hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "common/error/machine.hpp"
#include "common/output/atomic_file.hpp"

namespace toryu {

namespace {

constexpr std::size_t rows_of_chunk = 16384;   // 128 kB of double: few chunks, and each fits the cache
constexpr std::size_t smallest_chunked = 512;  // below it a chunk costs more than it saves

hid_t file_type(Stored stored) {
  switch (stored) {
    case Stored::float64:
      return H5T_IEEE_F64LE;
    case Stored::float32:
      return H5T_IEEE_F32LE;
    case Stored::int64:
      return H5T_STD_I64LE;
    case Stored::uint8:
      return H5T_STD_U8LE;
  }
  throw std::logic_error("HDF5: unknown storage");
}

/// The library would print each error, which are thrown here, and at the exit of the program write what it
/// could not write before, which crashes on a full disk.
[[maybe_unused]] const bool prepared = [] {
  // A file has one writer, and none is read before it is whole; not every file system has locks.
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return true;
}();

/// Finds "errno = 28" in what the library says of a failed call of the system.
herr_t find_errno(unsigned, const H5E_error2_t* error, void* found) {
  const char* place = error->desc ? std::strstr(error->desc, "errno = ") : nullptr;
  if (place) *static_cast<int*>(found) = std::atoi(place + std::strlen("errno = "));
  return 0;
}

}  // namespace

void hdf5_must(bool holds, const std::string& what) {
  if (holds) return;
  int error = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_errno, &error);
  if (error != 0) throw MachineFailure("cannot " + what, error);
  throw std::runtime_error(fmt::format("HDF5: cannot {}", what));
}

HdfHandle::HdfHandle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
  hdf5_must(id >= 0, what);
}
HdfHandle::HdfHandle(HdfHandle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
HdfHandle::~HdfHandle() {
  if (id_ >= 0) close_(id_);
}

HdfFile::HdfFile(std::filesystem::path path) : path_(std::move(path)), temporary_(part_of(path_)) {
  file_ = H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  hdf5_must(file_ >= 0, fmt::format("write '{}'", temporary_.string()));
}

HdfFile::~HdfFile() {
  if (file_ < 0) return;
  H5Fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void HdfFile::group(const std::string& name) {
  HdfHandle(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
            "make group " + name);
}

void HdfFile::write(const std::string& name, const void* values, hid_t type, std::size_t count, int columns,
                    Stored stored) {
  const std::size_t rows = count / static_cast<std::size_t>(columns);
  const int rank = columns == 1 ? 1 : 2;
  const hsize_t shape[2] = {rows, static_cast<hsize_t>(columns)};
  const HdfHandle space(H5Screate_simple(rank, shape, nullptr), H5Sclose, "shape " + name);
  const HdfHandle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "lay out " + name);
  H5Pset_obj_track_times(layout, false);  // equal runs give equal files
  if (rows >= smallest_chunked) {
    const hsize_t chunk[2] = {std::min(rows, rows_of_chunk), static_cast<hsize_t>(columns)};
    H5Pset_chunk(layout, rank, chunk);
    H5Pset_shuffle(layout);
    H5Pset_deflate(layout, 1);  // higher levels save a few per cent and cost several times the time
  }
  const HdfHandle set(
      H5Dcreate2(file_, name.c_str(), file_type(stored), space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose,
      "make dataset " + name);
  hdf5_must(rows == 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0,
            "write dataset " + name);
}

void HdfFile::dataset(const std::string& name, std::span<const double> values, int columns, Stored stored) {
  write(name, values.data(), H5T_NATIVE_DOUBLE, values.size(), columns, stored);
}
void HdfFile::dataset(const std::string& name, std::span<const std::int64_t> values, Stored stored) {
  write(name, values.data(), H5T_NATIVE_INT64, values.size(), 1, stored);
}

void HdfFile::write_attribute(const std::string& object, const std::string& name, hid_t stored, hid_t type,
                              hid_t space, const void* value) {
  const std::string what = fmt::format("write attribute {} of {}", name, object);
  const HdfHandle owner(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose, what);
  const HdfHandle attribute(H5Acreate2(owner, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT),
                            H5Aclose, what);
  hdf5_must(H5Awrite(attribute, type, value) >= 0, what);
}

void HdfFile::attribute(const std::string& object, const std::string& name, const std::string& text) {
  const HdfHandle type(H5Tcopy(H5T_C_S1), H5Tclose, "copy a type");
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));  // HDF5 has no text of length 0
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const HdfHandle space(H5Screate(H5S_SCALAR), H5Sclose, "shape " + name);
  write_attribute(object, name, type, type, space, text.c_str());
}

void HdfFile::attribute(const std::string& object, const std::string& name,
                        std::span<const std::int64_t> values) {
  const hsize_t count = values.size();
  const HdfHandle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "shape " + name);
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space, values.data());
}

void HdfFile::attribute(const std::string& object, const std::string& name, double value) {
  const HdfHandle space(H5Screate(H5S_SCALAR), H5Sclose, "shape " + name);
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, &value);
}

void HdfFile::close() {
  // A full disk shows when the file is flushed; closing does not always tell of it.
  hdf5_must(H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0, fmt::format("write '{}'", temporary_.string()));
  hdf5_must(H5Fclose(std::exchange(file_, H5I_INVALID_HID)) >= 0,
            fmt::format("complete '{}'", temporary_.string()));
}

}  // namespace toryu
