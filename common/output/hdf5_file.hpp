/// A new HDF5 file: groups, attributes and compressed datasets, with handles that close themselves. The file
/// is written as `PATH.part` and gets its name (`give_name`) once `close` has closed it, so a half-written
/// file never bears it.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace toryu {

/// Throws if a call of the library has just failed: MachineFailure with the reason if the system refused
/// something, else std::runtime_error. `what` could not be done: "write 'a.h5'".
void hdf5_must(bool holds, const std::string& what);

/// An identifier of the HDF5 library, closed at the end of its scope. Throws as `hdf5_must` if the library
/// returned none.
class HdfHandle {
 public:
  using Close = herr_t (*)(hid_t);
  HdfHandle(hid_t id, Close close, const std::string& what);
  HdfHandle(HdfHandle&& other) noexcept;
  HdfHandle(const HdfHandle&) = delete;
  HdfHandle& operator=(HdfHandle&&) = delete;
  ~HdfHandle();
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// How numbers are kept in the file; the library converts.
enum class Stored { float64, float32, int64, uint8 };

class HdfFile {
 public:
  explicit HdfFile(std::filesystem::path path);
  /// Without `close`, the unfinished file is removed.
  ~HdfFile();
  HdfFile(const HdfFile&) = delete;
  HdfFile& operator=(const HdfFile&) = delete;

  /// Makes the group `name` ("/VTKHDF/PointData"); those above it must be there.
  void group(const std::string& name);
  /// A table of `values.size() / columns` rows; of one dimension if `columns` is 1. Compressed if it is not
  /// tiny.
  void dataset(const std::string& name, std::span<const double> values, int columns, Stored stored);
  void dataset(const std::string& name, std::span<const std::int64_t> values, Stored stored);
  /// Attributes of the group or dataset `object`. Text is of fixed length and ASCII, as VTK 9.1 asks for.
  void attribute(const std::string& object, const std::string& name, const std::string& text);
  void attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values);
  void attribute(const std::string& object, const std::string& name, double value);

  /// Closes the file, which is whole then. Throws MachineFailure if that fails (a full disk).
  void close();

 private:
  void write(const std::string& name, const void* values, hid_t type, std::size_t count, int columns,
             Stored stored);
  void write_attribute(const std::string& object, const std::string& name, hid_t stored, hid_t type,
                       hid_t space, const void* value);
  std::filesystem::path path_, temporary_;
  hid_t file_ = H5I_INVALID_HID;
};

}  // namespace toryu
