#include "common/link/run_secret.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "common/error/machine.hpp"

namespace toryu {

namespace {

using namespace std::chrono_literals;
constexpr std::size_t digits = 16;    // of each of the two numbers
constexpr auto longest_writing = 1s;  // of a line; later who began it is dead

std::filesystem::path secret_file(const std::filesystem::path& out) {
  return out / "run.secret";
}

/// Nothing if the file is not there or not whole yet; throws if it may not be read.
std::optional<RunSecret> read_secret(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 && errno != ENOENT)
    throw MachineFailure(fmt::format("cannot read '{}'", path.string()), errno);
  if (file < 0) return std::nullopt;
  std::string text(2 * digits, '\0');
  const auto length = read(file, text.data(), text.size());
  close(file);
  if (length != static_cast<ssize_t>(text.size()) || text.find_first_not_of("0123456789abcdef") != text.npos)
    return std::nullopt;
  return RunSecret{std::stoull(text.substr(0, digits), nullptr, 16),
                   std::stoull(text.substr(digits), nullptr, 16)};
}

/// Writes a new secret unless the file is there.
void make_secret(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (file < 0 && errno == EEXIST) return;
  std::random_device random;
  const std::string text = fmt::format("{:08x}{:08x}{:08x}{:08x}\n", random(), random(), random(), random());
  const bool written =
      file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (file >= 0) close(file);
  if (!written) throw MachineFailure(fmt::format("cannot write '{}'", path.string()), reason);
}

}  // namespace

RunSecret run_secret(const std::filesystem::path& out) {
  const auto path = secret_file(out);
  if (const auto secret = read_secret(path)) return *secret;
  std::filesystem::create_directories(out);
  for (;;) {
    const auto start = std::chrono::steady_clock::now();
    make_secret(path);
    while (std::chrono::steady_clock::now() - start < longest_writing) {
      if (const auto secret = read_secret(path)) return *secret;
      std::this_thread::sleep_for(10ms);
    }
    unlink(path.c_str());
  }
}

bool has_run_secret(const std::filesystem::path& out) {
  return read_secret(secret_file(out)).has_value();
}

void forget_run_secret(const std::filesystem::path& out) noexcept {
  unlink(secret_file(out).c_str());
}

}  // namespace toryu
