/// What made the numbers of a run.
#pragma once

#include <string>

namespace toryu {

/// Version, commit of the sources, compiler, flags, processor.
struct Provenance {
  std::string version, commit, compiler, flags, cpu;
  int threads = 1;
};
Provenance provenance(int threads);

}  // namespace toryu
