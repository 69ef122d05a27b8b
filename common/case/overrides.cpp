#include "common/case/overrides.hpp"

#include "common/case/depth.hpp"
#include "common/case/nearest_word.hpp"
#include "common/error/counted.hpp"

namespace toryu {

namespace {

/// The value as a document with the one key `value`, so that it carries the place of the override.
toml::table parse_value(const std::string& value, const std::string& place) {
  try {
    toml::table document = parse_document("value = " + value, place);
    if (document.size() == 1) return document;
  } catch (const BadInput&) {
    // Not TOML, so it is text that needs no quotes.
  }
  toml::table document = parse_document("value = ''", place);
  *document.get_as<std::string>("value") = value;
  return document;
}

/// Puts `value` under a key that is placed in the override, even if the file has the same key.
toml::node* put(toml::table& table, const std::string& key, toml::node&& value,
                const toml::source_region& place) {
  table.erase(key);
  return &table.insert(toml::key(key, toml::source_region(place)), std::move(value)).first->second;
}

std::string no_such_item(const toml::array& array, const std::string& part, const std::string& path) {
  std::vector<std::string> names;
  for (const auto& item : array)
    if (const auto* table = item.as_table())
      if (const auto name = (*table)["name"].value<std::string>()) names.push_back(*name);
  const std::string size = fmt::format("{} has {}, counted from 0", path, counted(array.size(), "item"));
  return fmt::format("no item '{}': {}{}{}", part, size, names.empty() ? "" : ", named " + quoted_list(names),
                     did_you_mean(part, names));
}

/// The value is stored as the last part of the path below `node`; sections on the way are created.
std::string store(toml::node* node, const std::vector<std::string>& parts, toml::node&& value,
                  const toml::source_region& place) {
  std::string path;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const bool last = i + 1 == parts.size();
    if (toml::table* table = node->as_table()) {
      toml::node* inner = table->get(part);
      const bool taken_away = inner && inner->value_exact<bool>() == false;
      if (last)
        node = put(*table, part, std::move(value), place);  // NOLINT(bugprone-use-after-move): the last turn
      else
        node = inner && !taken_away ? inner : put(*table, part, toml::table(), place);
    } else if (toml::array* array = node->as_array()) {
      const auto index = item_index(*array, part);
      if (!index) return no_such_item(*array, part, path);
      if (last) array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(*index), std::move(value));
      node = array->get(*index);
    } else {
      return fmt::format("'{}' is {}, not a section with a key '{}'", path, found(*node), part);
    }
    path += (path.empty() ? "" : ".") + part;
  }
  return "";
}

}  // namespace

std::optional<InputError> apply_override(toml::table& root, const std::string& text) {
  const std::string typed = override_place(text);
  const auto equals = text.find('=');
  const auto parts = split_path(text.substr(0, equals));
  bool empty_part = false;
  for (const auto& part : parts) empty_part |= part.empty();
  if (equals == std::string::npos || empty_part)
    return InputError{.place = typed, .message = "expected section.key=value"};
  if (parts.size() > most_key_parts)
    return InputError{.place = typed, .message = fmt::format("a key of more than {} parts", most_key_parts)};

  toml::table document = parse_value(text.substr(equals + 1), typed);
  toml::node& value = *document.get("value");
  const toml::source_region place = document.find("value")->first.source();
  const std::string wrong = store(&root, parts, std::move(value), place);
  if (!wrong.empty()) return InputError{.place = typed, .message = wrong};
  return std::nullopt;
}

}  // namespace toryu
