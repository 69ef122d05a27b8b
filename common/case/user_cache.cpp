#include "common/case/user_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace toryu {

namespace fs = std::filesystem;

fs::path cached_file(const std::string& name) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "toryu" / name;
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache/toryu" / name;
  return {};
}

void keep_cached(const fs::path& file, const std::string& text) {
  std::error_code none;
  fs::create_directories(file.parent_path(), none);
  const fs::path part = fmt::format("{}.{}.part", file.string(), getpid());
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (stream) fs::rename(part, file, none);
  if (!stream || none) fs::remove(part, none);
}

}  // namespace toryu
