#include "common/output/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "common/error/machine.hpp"

namespace toryu {

void write_atomically(const std::filesystem::path& path, std::string_view text) {
  const std::filesystem::path temporary = part_of(path);
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) fail_to_write(temporary, errno);
  give_name(path);
}

void synchronise(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) close(descriptor);
  if (!done) fail_to_write(path, reason);
}

std::filesystem::path part_of(const std::filesystem::path& path) {
  return path.string() + ".part";
}

void give_name(const std::filesystem::path& path) {
  synchronise(part_of(path));  // else a name may survive a power cut, and what it names not
  std::error_code failure;
  std::filesystem::rename(part_of(path), path, failure);
  if (failure) throw MachineFailure(fmt::format("cannot complete '{}'", path.string()), failure.value());
}

void fail_to_write(const std::filesystem::path& path, int error) {
  throw MachineFailure(fmt::format("cannot write '{}'", path.string()), error);
}

}  // namespace toryu
