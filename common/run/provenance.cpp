#include "common/run/provenance.hpp"

#include <fstream>

#include "toryu_commit.hpp"

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

}  // namespace

Provenance provenance(int threads) {
  return {.version = TORYU_VERSION,
          .commit = TORYU_COMMIT,
          .compiler = TORYU_COMPILER,
          .flags = TORYU_FLAGS,
          .cpu = cpu_model(),
          .threads = threads};
}

}  // namespace toryu
