#include "common/run/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/run/log.hpp"

namespace toryu {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& out, const char* message) {
  throw BadInput({{.place = out.string(), .message = message}});
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& out)
    : file_(open((out / "run.lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
  if (file_ < 0 && is_fault_of_path(errno)) refuse(out, "cannot write to this folder");
  if (file_ < 0) throw MachineFailure(fmt::format("cannot write '{}'", (out / "run.lock").string()), errno);
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK) {
    close(file_);
    refuse(out, "another run writes its results here; wait for it or give --out another folder");
  }
  log::warn("the file system of {} has no locks ({}): nothing keeps a second run out of it", out.string(),
            std::strerror(errno));
}

RunLock::~RunLock() {
  close(file_);
}

}  // namespace toryu
