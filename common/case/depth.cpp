#include "common/case/depth.hpp"

#include <algorithm>

#include "common/error/failure.hpp"

namespace toryu {

namespace {

/// Where the string ends that begins at `at`: behind its quotes, or at the end of the line that leaves it
/// open.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view three = text.substr(at, 3);
  const bool several_lines = three.size() == 3 && three[1] == quote && three[2] == quote;
  for (std::size_t i = at + (several_lines ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"')
      ++i;
    else if (several_lines ? text.substr(i, 3) == three : text[i] == quote)
      return i + (several_lines ? 3 : 1);
    else if (text[i] == '\n' && !several_lines)
      return i;
  }
  return text.size();
}

bool deeper_than(const toml::node& node, std::size_t levels) {
  const auto deeper = [&](const toml::node& inner) { return levels == 0 || deeper_than(inner, levels - 1); };
  if (const toml::table* table = node.as_table())
    return std::any_of(table->begin(), table->end(), [&](const auto& entry) { return deeper(entry.second); });
  if (const toml::array* array = node.as_array()) return std::any_of(array->begin(), array->end(), deeper);
  return false;
}

}  // namespace

void check_keys(const std::string& text, const std::string& place) {
  std::size_t dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'')
      i = end_of_string(text, i) - 1;
    else if (c == '#')
      i = std::min(text.find('\n', i), text.size()) - 1;
    else if (c == '.')
      ++dots;
    else if (std::string_view(",=[]{}\n").find(c) != std::string_view::npos)
      dots = 0;
    if (dots < most_key_parts) continue;
    const auto here = text.begin() + static_cast<std::ptrdiff_t>(i);
    throw BadInput({{.place = place,
                     .line = static_cast<int>(std::count(text.begin(), here, '\n')) + 1,
                     .column = static_cast<int>(i - (text.rfind('\n', i) + 1)) + 1,
                     .message = fmt::format("a key of more than {} parts", most_key_parts)}});
  }
}

void check_levels(const toml::table& document, const std::string& place) {
  if (deeper_than(document, most_levels))
    throw BadInput(
        {{.place = place,
          .line = 1,
          .column = 1,
          .message = fmt::format("tables and lists within each other on more than {} levels", most_levels)}});
}

}  // namespace toryu
