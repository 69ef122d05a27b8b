/// Time of one exchange through the whole chain, coupler -> fluid -> coupler -> solid -> coupler, when
/// neither side computes: three processes, as in a run. Usage: round_trip [EXCHANGES]
///
/// To compare: bare Cyclone DDS with this configuration took 61, 73 and 150 microseconds at the median for 64
/// B, 4 kB and 64 kB in both directions, a chain of pipes 23, 26 and 88 (measured on 2 idle cores with
/// real-time scheduling).
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/link/coupler_link.hpp"

namespace {

using namespace toryu;

constexpr int warm_up = 200;  // exchanges

LinkSettings settings_for(const std::string& role, std::size_t particles) {
  LinkSettings settings;
  settings.role = role;
  settings.out =
      std::filesystem::temp_directory_path() / fmt::format("toryu_round_trip_{}_{}", getppid(), particles);
  return settings;
}

InterfaceMotion rest(std::size_t particles) {
  const std::vector<double> zero(dim * particles, 0.0);
  return {zero, zero};
}

void play_fluid(const LinkSettings& settings) {
  FluidLink link(settings);
  const std::size_t particles = link.join({.reach = 1, .time_step_limit = 1}).size();
  const InterfaceLoad load{
      std::vector<double>(particles, 1.0), std::vector<double>(dim * particles, 1.0), {}, Vec::Zero()};
  while (link.next_turn()) link.send(load, 1, {});
}

void play_solid(const LinkSettings& settings, std::size_t particles) {
  SolidLink link(settings);
  link.join();
  const std::vector<double> values(dim * particles, 1.0);
  link.register_interface({std::vector<std::uint32_t>(particles), values, std::vector<double>(particles),
                           values, std::vector<double>(particles), 1},
                          rest(particles));
  while (link.next_turn()) link.send(rest(particles), Vec::Zero(), {});
}

/// Seconds of each exchange, sorted.
std::vector<double> play_coupler(const LinkSettings& settings, int exchanges) {
  using Clock = std::chrono::steady_clock;
  CouplerLink link(settings);
  link.gather({});
  auto motion = link.begin({}).motion;
  std::vector<double> times;
  for (int n = 1; n <= warm_up + exchanges; ++n) {
    const Window window{static_cast<std::uint64_t>(n), 0, static_cast<double>(n), 1.0};
    const auto start = Clock::now();
    const auto load = link.ask_fluid(window, motion).load;
    motion = link.ask_solid(window, load).motion;
    if (n > warm_up) times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  link.stop(ExitCode::done, "");
  std::sort(times.begin(), times.end());
  return times;
}

/// Runs `play` in a process of its own.
template <class Play>
pid_t in_a_process(Play play) {
  const pid_t child = fork();
  if (child != 0) return child;
  play();
  std::exit(0);
}

/// The coupler runs in a process of its own too, since DDS must not be forked along.
void measure(std::size_t particles, int exchanges) {
  const std::size_t motion_bytes = 2 * dim * sizeof(double) * particles;
  const std::size_t load_bytes = (1 + dim) * sizeof(double) * particles;
  const pid_t processes[] = {
      in_a_process([=] { play_fluid(settings_for("fluid", particles)); }),
      in_a_process([=] { play_solid(settings_for("solid", particles), particles); }), in_a_process([=] {
        const auto times = play_coupler(settings_for("coupler", particles), exchanges);
        fmt::print("{:>9} {:>10} B {:>10} B {:>10.0f} us {:>10.0f} us\n", particles, motion_bytes, load_bytes,
                   1e6 * times[times.size() / 2], 1e6 * times[times.size() * 99 / 100]);
      })};
  for (const pid_t process : processes) waitpid(process, nullptr, 0);
}

}  // namespace

int main(int argc, char** argv) {
  spdlog::set_level(spdlog::level::warn);
  const int exchanges = argc > 1 ? std::stoi(argv[1]) : 5000;
  fmt::print("{:>9} {:>12} {:>12} {:>13} {:>13}\n", "particles", "motion", "load", "median", "99 percent");
  std::fflush(stdout);  // the processes that are made next must not print it again
  for (const std::size_t particles : {1, 85, 400, 1365, 5000}) measure(particles, exchanges);
  return 0;
}
