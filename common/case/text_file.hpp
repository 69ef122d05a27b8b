/// A text file that a user names: read whole, or refused by a sentence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace toryu {

constexpr std::uintmax_t largest_case = 4'000'000;        ///< [bytes] of a case file
constexpr std::uintmax_t largest_reference = 64'000'000;  ///< [bytes] of a reference

/// Whether `path` is a regular file; false as well where it cannot be looked at.
bool is_file(const std::filesystem::path& path);

/// The text of `file` without a byte order mark. Throws BadInput if it is no regular file, larger than
/// `largest` bytes, or cannot be read.
std::string read_text(const std::filesystem::path& file, std::uintmax_t largest);

}  // namespace toryu
