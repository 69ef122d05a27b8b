#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/error/counted.hpp"
#include "common/error/machine.hpp"
#include "common/output/atomic_file.hpp"
#include "common/output/results.hpp"

namespace toryu {

namespace {
using Clock = std::chrono::steady_clock;

std::vector<std::string> columns_of(const std::string& head) {
  std::vector<std::string> columns;
  std::istringstream cells(head);
  for (std::string cell; std::getline(cells, cell, ',');) columns.push_back(cell);
  return columns;
}

constexpr auto flush_interval = std::chrono::milliseconds(200);  // what a person watching takes for "now"
}  // namespace

struct SeriesWriter::File {
  std::filesystem::path path, temporary;
  std::ofstream stream;
  std::vector<std::string> columns;
  std::uint64_t rows = 0;
  /// Which value of a row stands in each column behind the time, -1 for none: after a restart with other
  /// observers. Empty: one after the other.
  std::vector<int> order;
  bool resumed = false;  ///< and no row written since
  Clock::time_point flushed = Clock::now();

  void open(std::ios::openmode mode) {
    stream.open(temporary, mode);
    must_be_good();
  }
  void must_be_good() const {
    if (!stream) fail_to_write(temporary, errno);
  }
  void adapt(const std::vector<std::string>& wanted);
};

/// Adds the columns of `wanted` that the file lacks, `nan` in all rows so far, and finds the order.
void SeriesWriter::File::adapt(const std::vector<std::string>& wanted) {
  resumed = false;
  if (wanted == columns) return;
  std::size_t more = 0;
  for (const auto& name : wanted)
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) {
      columns.push_back(name);
      ++more;
    }
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const auto found = std::find(wanted.begin(), wanted.end(), columns[k]);
    order.push_back(found == wanted.end() ? -1 : static_cast<int>(found - wanted.begin()) - 1);
  }
  if (more == 0) return;
  std::string empty;
  for (std::size_t k = 0; k < more; ++k) empty += ",nan";
  stream.close();
  std::ifstream old(temporary);
  std::string line, text = fmt::format("{}\n", fmt::join(columns, ","));
  std::getline(old, line);  // the former head
  while (std::getline(old, line)) text += line + empty + '\n';
  old.close();
  write_atomically(temporary, text);
  open(std::ios::app);
}

SeriesWriter::SeriesWriter(const std::filesystem::path& out, const std::string& name)
    : file_(std::make_unique<File>()) {
  std::filesystem::create_directories(out);
  file_->path = out / (name + ".csv");
  file_->temporary = part_of(file_->path);
}

SeriesWriter::~SeriesWriter() {
  try {
    complete();
  } catch (const MachineFailure&) {
    // of a run that failed, which says why; the .part that stays behind tells
  }
}

void SeriesWriter::complete() {
  if (!file_->stream.is_open()) return;
  file_->stream.close();
  file_->must_be_good();
  give_name(file_->path);
}

void SeriesWriter::write(double time, const std::vector<Observation>& row) {
  if (file_->columns.empty() || file_->resumed) {
    std::vector<std::string> names{"time[s]"};
    for (const auto& [name, unit, value] : row) names.push_back(fmt::format("{}[{}]", name, unit));
    if (file_->resumed) {
      file_->adapt(names);
    } else {
      file_->open(std::ios::trunc);
      file_->columns = names;
      file_->stream << fmt::format("{}\n", fmt::join(names, ","));
    }
  }
  const bool in_order = file_->order.empty();
  if (in_order && row.size() + 1 != file_->columns.size())
    throw std::logic_error(fmt::format("series '{}': a row of {} values under {} columns",
                                       file_->path.string(), row.size() + 1, file_->columns.size()));
  // The shortest text that reads back as the same double, so that equal runs give equal files.
  std::string line = fmt::format("{}", time);
  if (in_order)
    for (const auto& observation : row) line += fmt::format(",{}", observation.value);
  for (const int k : file_->order)
    line += k < 0 ? ",nan" : fmt::format(",{}", row[static_cast<std::size_t>(k)].value);
  file_->stream << line << '\n';
  ++file_->rows;
  if (const auto now = Clock::now(); now - file_->flushed > flush_interval) {
    file_->stream.flush();
    file_->flushed = now;
  }
  file_->must_be_good();
}

SeriesWriter::State SeriesWriter::state() {
  if (file_->columns.empty()) return {};
  file_->stream.flush();
  file_->must_be_good();
  synchronise(file_->temporary);
  return {file_->columns, file_->rows};
}

void SeriesWriter::resume(const State& then) {
  if (then.columns.empty()) return;
  const bool completed = !std::filesystem::exists(file_->temporary);
  const std::filesystem::path& there = completed ? file_->path : file_->temporary;
  const auto refuse = [&](const std::string& why) {
    throw BadInput({{.place = there.string(), .message = "cannot go on: " + why}});
  };
  std::ifstream file(there, std::ios::binary);
  std::string line;
  if (!file) refuse(std::strerror(errno));
  std::uintmax_t size = 0;
  const auto next = [&] {
    const bool whole = std::getline(file, line) && !file.eof();
    if (whole) size += line.size() + 1;
    return whole;
  };
  if (!next()) refuse("it has no head");
  const auto columns = columns_of(line);
  for (; file_->rows < then.rows; ++file_->rows)
    if (!next())
      refuse(fmt::format("it has {}, and had {} at the checkpoint", counted(file_->rows, "row"), then.rows));
  file.close();
  if (completed) std::filesystem::rename(file_->path, file_->temporary);
  std::filesystem::resize_file(file_->temporary, size);
  file_->columns = columns;
  file_->resumed = true;
  file_->open(std::ios::app);
}

}  // namespace toryu
