/// What a power cut leaves: a name is given to a file once its content is on the disk, never before.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/output/hdf5_series.hpp"
#include "common/output/results.hpp"
#include "common/state/checkpoint.hpp"
#include "tests/unit/common/output/sample_results.hpp"

namespace {
std::vector<std::string> calls;  // "fsync PATH" and "rename PATH", PATH being the former name
}  // namespace

// Those of the C library, heard on their way.
extern "C" int fsync(int file) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  if (readlink(link.c_str(), path.data(), path.size() - 1) > 0)
    calls.push_back(std::string("fsync ") + path.data());
  return static_cast<int>(syscall(SYS_fsync, file));
}
extern "C" int rename(const char* from, const char* to) noexcept {
  calls.push_back(std::string("rename ") + from);
  return static_cast<int>(syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
}

namespace toryu {
namespace {

namespace fs = std::filesystem;

class Durability : public testing::Test {
 protected:
  Durability() {
    fs::remove_all(out);
    fs::create_directories(out);
    calls.clear();
  }
  ~Durability() override { fs::remove_all(out); }

  /// Checks that each of `count` names at least was given to what had reached the disk.
  static void expect_synchronised(int count) {
    for (auto call = calls.begin(); call != calls.end(); ++call) {
      if (!call->starts_with("rename ")) continue;
      EXPECT_TRUE(std::find(calls.begin(), call, "fsync " + call->substr(7)) != call) << *call;
      --count;
    }
    EXPECT_LE(count, 0) << "of the names were not given";
  }

  fs::path out = fs::canonical(fs::temp_directory_path()) / ("toryu_durability_" + std::to_string(getpid()));
};

TEST_F(Durability, OfFramesAndTheirSeries) {
  FrameWriter(out, "fluid", sample::provenance).write(0.0, sample::frame());
  expect_synchronised(2);
}

TEST_F(Durability, OfASeriesAndOfASummary) {
  SeriesWriter series(out, "fluid");
  series.write(0, {{"kinetic_energy", "J/m", 0.5}});
  series.complete();
  write_summary(out, sample::summary());
  expect_synchronised(2);
}

TEST_F(Durability, OfACheckpoint) {
  const fs::path folder = open_checkpoint(out);
  write_part(folder, "fluid", {"fluid_solver"}, [](std::ostream& stream) { stream << "state"; });
  complete_checkpoint(folder, 0.5, "[case]\n", {"fluid"});
  expect_synchronised(3);
}

}  // namespace
}  // namespace toryu
