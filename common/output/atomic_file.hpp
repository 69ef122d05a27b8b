/// A text file that is either there in full or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace toryu {

/// Writes `PATH.part` and renames it. Throws MachineFailure, naming the file and the reason, if it fails.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// Brings a file or folder to the disk. Throws MachineFailure likewise.
void synchronise(const std::filesystem::path& path);

/// `PATH.part`, the name of a file that is not whole yet.
std::filesystem::path part_of(const std::filesystem::path& path);

/// Renames `PATH.part` to `path`, once it is on the disk. Throws MachineFailure likewise.
void give_name(const std::filesystem::path& path);

/// Throws MachineFailure: `path` cannot be written for the reason `error`, an errno.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error);

}  // namespace toryu
