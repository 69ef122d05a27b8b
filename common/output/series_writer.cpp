#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "common/output/results.hpp"

namespace toryu {

namespace {
using Clock = std::chrono::steady_clock;
constexpr auto flush_interval = std::chrono::milliseconds(200);  // what a person watching takes for "now"
}  // namespace

struct SeriesWriter::File {
  std::filesystem::path path, temporary;
  std::ofstream stream;
  std::vector<std::string> columns;
  Clock::time_point flushed = Clock::now();

  void must_be_good() const {
    if (!stream)
      throw std::runtime_error(
          fmt::format("cannot write '{}': {}", temporary.string(), std::strerror(errno)));
  }
};

SeriesWriter::SeriesWriter(const std::filesystem::path& out, const std::string& name)
    : file_(std::make_unique<File>()) {
  std::filesystem::create_directories(out);
  file_->path = out / (name + ".csv");
  file_->temporary = out / (name + ".csv.part");
  file_->stream.open(file_->temporary, std::ios::trunc);
  file_->must_be_good();
}

SeriesWriter::~SeriesWriter() {
  file_->stream.close();
  std::error_code ignored;  // a destructor must not throw; the .part that stays behind tells
  if (file_->columns.empty())
    std::filesystem::remove(file_->temporary, ignored);
  else if (file_->stream)
    std::filesystem::rename(file_->temporary, file_->path, ignored);
}

void SeriesWriter::write(double time, const std::vector<Observation>& row) {
  std::string line;
  if (file_->columns.empty()) {
    file_->columns.emplace_back("time[s]");
    for (const auto& [name, unit, value] : row) file_->columns.push_back(fmt::format("{}[{}]", name, unit));
    line = fmt::format("{}\n", fmt::join(file_->columns, ","));
  }
  if (row.size() + 1 != file_->columns.size())
    throw std::logic_error(fmt::format("series '{}': a row of {} values under {} columns",
                                       file_->path.string(), row.size() + 1, file_->columns.size()));
  // The shortest text that reads back as the same double, so that equal runs give equal files.
  line += fmt::format("{}", time);
  for (const auto& observation : row) line += fmt::format(",{}", observation.value);
  file_->stream << line << '\n';
  if (const auto now = Clock::now(); now - file_->flushed > flush_interval) {
    file_->stream.flush();
    file_->flushed = now;
  }
  file_->must_be_good();
}

}  // namespace toryu
