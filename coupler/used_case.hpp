/// `used_case.toml` of a coupled run: each program knows its own sections, and all know the common ones.
#pragma once

#include <string>
#include <vector>

namespace toryu::coupling {

/// Joins TOML texts; a top-level section comes from the first text that has it.
std::string merge_used_cases(const std::vector<std::string>& texts);

}  // namespace toryu::coupling
