/// One run at a time in a results folder: held by its lead, the coupler or a solver alone.
#pragma once

#include <filesystem>

namespace toryu {

/// Holds `run.lock` in the folder while it lives; the system frees it if the process dies. Throws
/// BadInput if another run holds it. On a file system without locks it only warns.
class RunLock {
 public:
  explicit RunLock(const std::filesystem::path& out);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  int file_;
};

}  // namespace toryu
