#include "common/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "common/run/standard_streams.hpp"

namespace toryu {

namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds terminal_interval{0.2}, file_interval{10};

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

std::string progress_line(double time, double end_time, long count, const std::string& unit, double seconds) {
  const double share = std::clamp(time / end_time, 0.0, 1.0);
  const double rate = seconds > 0 ? static_cast<double>(count) / seconds : 0;
  const std::string left = share > 0 ? duration_text(seconds * (1 - share) / share) : "unknown time";
  return fmt::format("t {:.4f} of {:.4f} s, {:3.0f} %, {} {}, {:.0f} {}s/s, {} left", time, end_time,
                     100 * share, unit, count, rate, unit, left);
}

Progress::Progress(double end_time, std::string unit)
    : end_time_(end_time),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (terminal_ && printed_) tell("\n");
}

void Progress::update(double time, long count) {
  const auto now = std::chrono::steady_clock::now();
  const bool end = time >= end_time_;
  if (!end && now - last_ < (terminal_ ? terminal_interval : file_interval)) return;
  last_ = now;
  print(time, count);
}

void Progress::print(double time, long count) {
  const Seconds elapsed = std::chrono::steady_clock::now() - start_;
  const std::string line = progress_line(time, end_time_, count, unit_, elapsed.count());
  // On a terminal: back to the start of the line, write, clear what is left of the line before.
  if (terminal_)
    tell(fmt::format("\r{}\033[K", line));
  else
    tell(line + '\n');
  printed_ = true;
}

}  // namespace toryu
