#include "common/case/user_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

#include "common/case/text_file.hpp"
#include "common/error/failure.hpp"

namespace toryu {

namespace fs = std::filesystem;

namespace {

/// Without it a file was cut.
constexpr const char* last_line = "# whole\n";
constexpr std::uintmax_t largest_file = 2'000'000'000;  // [bytes]

}  // namespace

fs::path cached_file(const std::string& name) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "toryu" / name;
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache/toryu" / name;
  return {};
}

std::optional<std::string> read_cached(const fs::path& file) {
  if (file.empty() || !is_file(file)) return {};
  try {
    std::string text = read_text(file, largest_file);
    if (!text.ends_with(last_line)) return {};
    text.erase(text.size() - std::strlen(last_line));
    return text;
  } catch (const BadInput&) {
    return {};
  }
}

void keep_cached(const fs::path& file, const std::string& text) {
  if (file.empty()) return;
  std::error_code none;
  fs::create_directories(file.parent_path(), none);
  const fs::path part = fmt::format("{}.{}.part", file.string(), getpid());
  std::ofstream stream(part, std::ios::binary);
  stream << text << last_line;
  stream.close();
  if (stream) fs::rename(part, file, none);
  if (!stream || none) fs::remove(part, none);
}

}  // namespace toryu
