// VTKHDF 1.0 UnstructuredGrid, the one layout of that format that Debian 12's VTK 9.1 and ParaView 5.11 read:
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html. Each particle is a cell of one vertex.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "common/output/atomic_file.hpp"
#include "common/output/hdf5_file.hpp"
#include "common/output/results.hpp"
#include "common/run/provenance.hpp"
#include "common/vector.hpp"

namespace toryu {

namespace {

constexpr int vtk_dim = 3;  // VTK's points and vectors are always of three dimensions
constexpr std::int64_t vtk_vertex = 1;

/// `dim` values a particle as three, the missing ones 0.
std::vector<double> in_three_dimensions(const std::vector<double>& values) {
  const std::size_t count = values.size() / dim;
  std::vector<double> wide(count * vtk_dim, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * dim), dim,
                wide.begin() + static_cast<std::ptrdiff_t>(i * vtk_dim));
  return wide;
}

void write_cells(HdfFile& file, std::int64_t count) {
  const std::int64_t one[] = {count};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    file.dataset(fmt::format("/VTKHDF/{}", name), one, Stored::int64);
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(count) + 1);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.dataset("/VTKHDF/Offsets", numbers, Stored::int64);
  numbers.pop_back();
  file.dataset("/VTKHDF/Connectivity", numbers, Stored::int64);
  file.dataset("/VTKHDF/Types", std::vector<std::int64_t>(static_cast<std::size_t>(count), vtk_vertex),
               Stored::uint8);
}

/// Fields are for looking at: seven digits do, at half the size. Positions stay double, so that displacements
/// much smaller than the scene can be taken from frames.
void write_field(HdfFile& file, const FrameField& field, std::size_t count) {
  if (field.values.size() != count * static_cast<std::size_t>(field.components))
    throw std::logic_error(fmt::format("frame: field '{}' has {} values for {} particles of {}", field.name,
                                       field.values.size(), count, field.components));
  const std::string name = "/VTKHDF/PointData/" + field.name;
  if (field.components == dim)
    file.dataset(name, in_three_dimensions(field.values), vtk_dim, Stored::float32);
  else
    file.dataset(name, field.values, field.components, Stored::float32);
  file.attribute(name, "unit", field.unit);
  file.attribute(name, "description", field.description);
}

void write_provenance(HdfFile& file, const Provenance& provenance, double time) {
  file.group("/provenance");
  const std::pair<const char*, const std::string&> texts[] = {{"version", provenance.version},
                                                              {"commit", provenance.commit},
                                                              {"compiler", provenance.compiler},
                                                              {"flags", provenance.flags},
                                                              {"cpu", provenance.cpu}};
  for (const auto& [name, text] : texts) file.attribute("/provenance", name, text);
  const std::int64_t threads[] = {provenance.threads};
  file.attribute("/provenance", "threads", threads);
  file.attribute("/provenance", "time[s]", time);
}

std::string frame_path(const std::string& name, std::size_t number) {
  return fmt::format("frames/{}_{:06}.hdf", name, number);
}

}  // namespace

FrameWriter::FrameWriter(std::filesystem::path out, std::string name, Provenance provenance)
    : out_(std::move(out)), name_(std::move(name)), provenance_(std::move(provenance)) {
  std::filesystem::create_directories(out_ / "frames");
}

void FrameWriter::write(double time, const Frame& frame) {
  const std::size_t count = frame.positions.size() / dim;
  const std::string path = frame_path(name_, state_.written.size());
  HdfFile file(out_ / path);
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Type", "UnstructuredGrid");
  const std::int64_t version[] = {1, 0};
  file.attribute("/VTKHDF", "Version", version);
  write_cells(file, static_cast<std::int64_t>(count));
  file.dataset("/VTKHDF/Points", in_three_dimensions(frame.positions), vtk_dim, Stored::float64);
  file.group("/VTKHDF/PointData");
  for (const auto& field : frame.fields) write_field(file, field, count);
  write_provenance(file, provenance_, time);
  file.close();

  complete();
  state_.written.emplace_back(path, time);
  // To bring a frame to the disk takes some milliseconds, in which the run goes on.
  naming_ = std::async(std::launch::async, [frame = out_ / path, list = list_path(), text = list_text()] {
    give_name(frame);
    write_atomically(list, text);
  });
}

void FrameWriter::complete() {
  if (naming_.valid()) naming_.get();
}

std::filesystem::path FrameWriter::list_path() const {
  return out_ / (name_ + ".hdf.series");
}

std::string FrameWriter::list_text() const {
  std::string list;
  for (const auto& [written, at] : state_.written)
    list += fmt::format("{}\n  {{ \"name\": \"{}\", \"time\": {} }}", list.empty() ? "" : ",", written, at);
  return fmt::format("{{ \"file-series-version\": \"1.0\", \"files\": [{}\n] }}\n", list);
}

void FrameWriter::resume(const State& then) {
  state_ = then;
  for (std::size_t k = then.written.size();; ++k)
    if (!std::filesystem::remove(out_ / frame_path(name_, k))) break;
  if (!state_.written.empty()) write_atomically(list_path(), list_text());
}

}  // namespace toryu
