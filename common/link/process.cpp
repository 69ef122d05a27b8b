#include "common/link/process.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace toryu {

namespace {

/// The boot and the space of process numbers, so that a container does not look like its host.
std::string machine() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code failure;
  return boot + std::filesystem::read_symlink("/proc/self/ns/pid", failure).string();
}

struct Stat {
  std::string state;  ///< one letter, see proc(5)
  std::string start;  ///< clock ticks since the boot: tells a process from a later one of the same number
};

std::optional<Stat> stat_of(const std::string& number) {
  std::ifstream file("/proc/" + number + "/stat");
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
  const std::string number = std::to_string(getpid());
  const auto stat = stat_of(number);
  return stat ? machine() + " " + number + " " + stat->start : "";
}

bool runs_here(const std::string& process) {
  std::istringstream parts(process);
  std::string where, number, start;
  if (!(parts >> where >> number >> start) || where != machine()) return false;
  const auto stat = stat_of(number);
  return stat && stat->start == start && std::string("TtZX").find(stat->state) == std::string::npos;
}

}  // namespace toryu
