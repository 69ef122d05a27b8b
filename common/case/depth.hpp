/// How deep a document goes. What parses, copies and frees one calls itself once a level, so a limit keeps it
/// on the stack.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace toryu {

constexpr std::size_t most_key_parts = 32;  ///< a.b.c has three
constexpr std::size_t most_levels = 64;     ///< of tables and lists within each other

/// Throws BadInput at the first key of more than `most_key_parts` parts in `text`, which was found at
/// `place`.
void check_keys(const std::string& text, const std::string& place);
/// Throws BadInput if `document` has more than `most_levels` levels.
void check_levels(const toml::table& document, const std::string& place);

}  // namespace toryu
