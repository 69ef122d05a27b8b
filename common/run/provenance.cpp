#include "common/run/provenance.hpp"

#include <dlfcn.h>

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

/// The program that this code is in, or the module of Python.
std::filesystem::path own_file() {
  Dl_info found{};
  const bool known = dladdr(reinterpret_cast<const void*>(&own_file), &found) != 0;
  if (known && std::filesystem::path(found.dli_fname).extension() == ".so") return found.dli_fname;
  std::error_code none;
  return std::filesystem::read_symlink("/proc/self/exe", none);
}

/// What the build left beside it.
std::string commit_of_sources() {
  std::ifstream file(own_file().replace_filename("commit.txt"));
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
