#include "common/run/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/error/failure.hpp"

namespace toryu {

RunLock::RunLock(const std::filesystem::path& out)
    : file_(open((out / "run.lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
  if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const bool held = file_ >= 0;
  if (held) close(file_);
  throw BadInput(
      {{.place = out.string(),
        .message = held ? "another run writes its results here; wait for it or give --out another folder"
                        : "cannot write to this folder"}});
}

RunLock::~RunLock() {
  close(file_);
}

}  // namespace toryu
