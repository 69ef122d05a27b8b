#include "coupler/interface_record.hpp"

#include <spdlog/spdlog.h>

#include <array>

#include "common/output/hdf5_file.hpp"

namespace toryu {

namespace {

constexpr hsize_t rows_per_chunk = 16;

void attribute(hid_t object, const std::string& name, const std::string& text) {
  const HdfHandle type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  H5Tset_size(type, text.size());
  const HdfHandle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const HdfHandle made(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                       name);
  H5Awrite(made, type, text.data());
}

/// A dataset that grows by a row of fixed shape.
class Series {
 public:
  Series(hid_t file, const std::string& name, const std::string& unit, std::vector<hsize_t> row_shape)
      : name_(name), shape_(std::move(row_shape)), dataset_(make(file)) {
    attribute(dataset_, "unit", unit);
  }

  void append(const double* row) {
    auto size = shape_, start = shape_;
    std::fill(start.begin(), start.end(), 0);
    size.insert(size.begin(), rows_ + 1);
    start.insert(start.begin(), rows_);
    auto count = size;
    count[0] = 1;
    if (H5Dset_extent(dataset_, size.data()) < 0) fail();
    const HdfHandle space(H5Dget_space(dataset_), H5Sclose, name_);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    const HdfHandle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose,
                           name_);
    if (H5Dwrite(dataset_, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, row) < 0) fail();
    ++rows_;
  }

 private:
  HdfHandle make(hid_t file) const {
    auto size = shape_, limit = shape_, chunk = shape_;
    size.insert(size.begin(), 0);
    limit.insert(limit.begin(), H5S_UNLIMITED);
    chunk.insert(chunk.begin(), rows_per_chunk);
    const HdfHandle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), limit.data()),
                          H5Sclose, name_);
    const HdfHandle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name_);
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 4);
    return {H5Dcreate2(file, name_.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
            H5Dclose, name_};
  }
  [[noreturn]] void fail() const { throw std::runtime_error("interface.h5: cannot write " + name_); }

  std::string name_;
  std::vector<hsize_t> shape_;
  HdfHandle dataset_;
  hsize_t rows_ = 0;
};

/// A dataset that is known at the start.
void constant(hid_t file, const std::string& name, const std::string& unit, hid_t type,
              const std::vector<hsize_t>& shape, const void* values) {
  const HdfHandle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                        name);
  const HdfHandle made(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose, name);
  H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  attribute(made, "unit", unit);
}

}  // namespace

struct InterfaceRecord::File {
  File(std::filesystem::path final_path, std::size_t count)
      : path(std::move(final_path)),
        file(H5Fcreate((path.string() + ".part").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
             path.string()),
        time(file, "time", "s", {}),
        position(file, "position", "m", {count, dim}),
        velocity(file, "velocity", "m/s", {count, dim}),
        acceleration(file, "acceleration", "m/s2", {count, dim}),
        pressure(file, "pressure", "Pa", {count}),
        force(file, "force", "N/m", {count, dim}),
        friction_force(file, "friction_force", "N/m", {count, dim}) {}

  std::filesystem::path path;
  HdfHandle file;
  bool whole = true;  // all rows that were begun are complete
  Series time, position, velocity, acceleration, pressure, force, friction_force;
};

InterfaceRecord::InterfaceRecord(const std::filesystem::path& out, const Interface& interface)
    : file_(std::make_unique<File>(out / "interface.h5", interface.size())) {
  const hsize_t count = interface.size();
  constant(file_->file, "id", "1", H5T_NATIVE_UINT32, {count}, interface.id.data());
  constant(file_->file, "reference_position", "m", H5T_NATIVE_DOUBLE, {count, dim},
           interface.position.data());
  constant(file_->file, "volume", "m2", H5T_NATIVE_DOUBLE, {count}, interface.volume.data());
  constant(file_->file, "area_vector", "m", H5T_NATIVE_DOUBLE, {count, dim}, interface.area_vector.data());
}

InterfaceRecord::~InterfaceRecord() {
  const auto path = file_->path;
  // A full disk often shows only when the file is flushed; closing tells nothing of it.
  const bool whole = file_->whole && H5Fflush(file_->file, H5F_SCOPE_LOCAL) >= 0;
  file_.reset();
  if (!whole) {
    spdlog::error("{} could not be completed; what was written bears the name {}.part", path.string(),
                  path.filename().string());
    return;
  }
  std::error_code failure;
  std::filesystem::rename(path.string() + ".part", path, failure);
  if (failure) spdlog::error("{}: {}", path.string(), failure.message());
}

void InterfaceRecord::write(double time, const InterfaceMotion& motion, const InterfaceLoad& load) {
  const std::vector<double> none(motion.position.size(), 0.0);
  const auto row = [&](const std::vector<double>& values) {
    return values.empty() ? none.data() : values.data();
  };
  file_->whole = false;
  file_->time.append(&time);
  file_->position.append(motion.position.data());
  file_->velocity.append(motion.velocity.data());
  file_->acceleration.append(motion.acceleration.data());
  file_->pressure.append(row(load.pressure));
  file_->force.append(row(load.force));
  file_->friction_force.append(row(load.friction_force));
  file_->whole = true;
}

}  // namespace toryu
