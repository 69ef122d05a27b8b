#include "common/run/provenance.hpp"

#include <filesystem>
#include <fstream>

namespace toryu {

namespace {

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const auto colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

/// What the build left beside the program.
std::string commit_of_sources() {
  std::error_code none;
  std::ifstream file(std::filesystem::read_symlink("/proc/self/exe", none).replace_filename("commit.txt"));
  std::string commit;
  return std::getline(file, commit) ? commit : "unknown";
}

}  // namespace

Provenance provenance(int threads) {
  static const std::string commit = commit_of_sources(), cpu = cpu_model();
  return {.version = TORYU_VERSION,
          .commit = commit,
          .compiler = TORYU_COMPILER,
          .flags = TORYU_FLAGS,
          .cpu = cpu,
          .threads = threads};
}

}  // namespace toryu
