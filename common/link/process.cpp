#include "common/link/process.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace toryu {

namespace {

/// The boot and the space of process numbers, so that a container does not look like its host.
const std::string& machine() {
  static const std::string name = [] {
    std::string boot;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
    std::error_code failure;
    return boot + std::filesystem::read_symlink("/proc/self/ns/pid", failure).string();
  }();
  return name;
}

struct Stat {
  std::string state;  ///< one letter, see proc(5)
  std::string start;  ///< clock ticks since the boot: tells a process from a later one of the same number
};

std::optional<Stat> stat_of(pid_t number) {
  std::ifstream file("/proc/" + std::to_string(number) + "/stat");
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  // The second field is the program's name in brackets, which may hold anything; then field 3, the state.
  std::istringstream fields(text.substr(std::min(text.rfind(')'), text.size() - 1) + 1));
  Stat stat;
  fields >> stat.state;
  for (int field = 4; field <= 22; ++field) fields >> stat.start;
  if (!fields) return std::nullopt;
  return stat;
}

}  // namespace

std::string own_process() {
  const auto stat = stat_of(getpid());
  return stat ? machine() + " " + std::to_string(getpid()) + " " + stat->start : "";
}

std::string words_of_loss(const std::string& process) {
  return process.starts_with(machine()) ? "was killed or stopped" : "is gone, or its host or network is";
}

ProcessState state_of(const std::string& process) {
  std::istringstream parts(process);
  std::string where, start;
  pid_t number = 0;
  if (!(parts >> where >> number >> start) || where != machine()) return ProcessState::unknown;
  const auto stat = stat_of(number);
  // A process of another user may be hidden, but not from a signal.
  if (!stat) return kill(number, 0) != 0 && errno == ESRCH ? ProcessState::gone : ProcessState::unknown;
  if (stat->start != start || stat->state == "Z" || stat->state == "X") return ProcessState::gone;
  return stat->state == "T" || stat->state == "t" ? ProcessState::stopped : ProcessState::runs;
}

}  // namespace toryu
