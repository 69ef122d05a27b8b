/// A text file that is either there in full or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace toryu {

/// Writes `PATH.part` and renames it. Throws std::runtime_error, naming the file and the reason, if it fails.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// Brings a file or folder to the disk. Throws std::runtime_error likewise.
void synchronise(const std::filesystem::path& path);

}  // namespace toryu
