#include "common/error/machine.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace toryu {

namespace {

/// What a user can do about `error`, "" if that is not known.
const char* remedy(int error) {
  switch (error) {
    case ENOSPC:
      return "make room on the disk (df -h and df -i show it), or give --out a folder on another";
    case EDQUOT:
      return "your share of the disk is used up: make room, or give --out a folder on another";
    case EFBIG:
      return "files may not become that large here: raise 'ulimit -f', or give --out another folder";
    case ENOENT:
      return "the folder was removed or moved in mid-run; leave it where it is until the run has ended";
    case EACCES:
    case EPERM:
    case EROFS:
      return "give --out a folder that you may write to";
    case EMFILE:
    case ENFILE:
      return "too many files are open: raise 'ulimit -n'";
    case EAGAIN:
    case ENOMEM:
      return "too many processes or too little memory: end others, raise 'ulimit -u', or give --threads "
             "fewer";
    case EIO:
    case ESTALE:
    case ENODEV:
    case ENXIO:
      return "the disk or its connection is faulty: see 'dmesg', or give --out a folder on another";
    default:
      return "";
  }
}

}  // namespace

MachineFailure::MachineFailure(const std::string& what, int error)
    : std::runtime_error(
          fmt::format("{}: {}{}{}", what, std::strerror(error), *remedy(error) ? "; " : "", remedy(error))) {}

bool is_fault_of_path(int error) {
  for (const int wrong : {EACCES, EPERM, EROFS, ENOENT, ENOTDIR, EISDIR, EEXIST, ENAMETOOLONG, ELOOP, EINVAL})
    if (error == wrong) return true;
  return false;
}

MachineFailure machine_failure(const std::system_error& error) {
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return {fmt::format("'{}' cannot be used", file->path1().string()), file->code().value()};
  return {"the system refuses", error.code().value()};
}

}  // namespace toryu
