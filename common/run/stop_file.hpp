/// A file named `stop` in the results: the wish to end a run from outside its terminal.
#pragma once

#include <chrono>
#include <filesystem>

namespace toryu {

class StopFile {
 public:
  /// `out` is the folder of the results.
  explicit StopFile(const std::filesystem::path& out) : path_(out / "stop") {}

  /// Whether the file is there; looks at most five times a second. A file that was found is removed, so that
  /// it does not stop the next run as well; one that may not be removed counts all the same.
  bool found() {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < std::chrono::milliseconds(200)) return false;
    looked_ = now;
    std::error_code none;
    const bool there = std::filesystem::exists(path_, none);
    if (there) std::filesystem::remove(path_, none);
    return there;
  }

 private:
  std::filesystem::path path_;
  std::chrono::steady_clock::time_point looked_{};
};

}  // namespace toryu
