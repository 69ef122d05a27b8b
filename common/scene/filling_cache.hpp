/// Fillings of outlines that took long, kept for the next run.
#pragma once

#include <filesystem>
#include <optional>

#include "common/scene/fill_outline.hpp"

namespace toryu {

/// Where the filling of `outline` by particles of `spacing` [m] is kept: by a hash of both and of the build,
/// for two targets of the compiler differ in the last digits. Empty if the user has no cache.
std::filesystem::path cached_filling(const Outline& outline, double spacing);

/// What is kept there: nothing if there is no such file, or no whole one.
std::optional<FittedFilling> read_filling(const std::filesystem::path& file);

void keep_filling(const FittedFilling& filling, const std::filesystem::path& file);

}  // namespace toryu
