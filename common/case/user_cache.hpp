/// What took a while to find, kept in files for later runs of the same user.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace toryu {

/// The file `name` in the user's cache, $XDG_CACHE_HOME/toryu or ~/.cache/toryu; empty if there is no such
/// place.
std::filesystem::path cached_file(const std::string& name);

/// What `keep_cached` wrote there; nothing if it is not there as a whole, or cannot be read.
std::optional<std::string> read_cached(const std::filesystem::path& file);

/// Writes `text` to a file of the cache. Other programs may read or write the same file: it is there whole or
/// not at all. Where nothing can be written nothing is kept.
void keep_cached(const std::filesystem::path& file, const std::string& text);

}  // namespace toryu
