#include "common/case/document.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "common/case/depth.hpp"
#include "common/error/counted.hpp"

namespace toryu {

namespace {
constexpr std::string_view override_option = "--set ";

/// Two changes of one name stay two items, so that whoever reads the list tells of them.
void merge_items(toml::array& base, toml::array&& changes) {
  std::set<std::string> names;
  for (auto& item : changes) {
    toml::table& table = *item.as_table();
    const auto name = table["name"].value<std::string>();
    const bool first = name && names.insert(*name).second;
    if (const auto index = first ? item_index(base, quoted(*name)) : std::nullopt)
      merge_document(*base.get(*index)->as_table(), std::move(table));
    else
      base.push_back(std::move(table));
  }
}
}  // namespace

toml::table parse_document(const std::string& text, const std::string& place) {
  check_keys(text, place);
  try {
    toml::table document = toml::parse(std::string_view(text), std::string_view(place));
    check_levels(document, place);
    return document;
  } catch (const toml::parse_error& error) {
    throw BadInput({fault_at(error.source(), fmt::format("not valid TOML: {}", error.description()))});
  }
}

void merge_document(toml::table& base, toml::table&& changes) {
  for (auto& [key, node] : changes) {
    toml::node* old = base.get(key.str());
    if (old && old->is_table() && node.is_table()) {
      merge_document(*old->as_table(), std::move(*node.as_table()));
    } else if (old && old->is_array_of_tables() && node.is_array_of_tables()) {
      merge_items(*old->as_array(), std::move(*node.as_array()));
    } else {
      base.erase(key.str());
      base.insert(toml::key(key), std::move(node));  // with its place, which a copy would lose
    }
  }
}

std::string override_place(const std::string& text) {
  return std::string(override_option) + text;
}

InputError fault_at(const toml::source_region& place, const std::string& message) {
  InputError fault{.place = place.path ? *place.path : std::string(), .message = message};
  if (!fault.place.starts_with(override_option)) {
    fault.line = static_cast<int>(place.begin.line);
    fault.column = static_cast<int>(place.begin.column);
  }
  return fault;
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : path) {
    quoted ^= c == '"';
    if (c == '.' && !quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::string quoted(const std::string& name) {
  return '"' + name + '"';
}

std::optional<std::size_t> item_index(const toml::array& array, const std::string& part) {
  std::size_t number = 0;
  const auto end = part.data() + part.size();
  const auto [rest, error] = std::from_chars(part.data(), end, number);
  if (error == std::errc() && rest == end)
    return number < array.size() ? std::optional(number) : std::nullopt;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const toml::table* table = array.get(i)->as_table();
    const auto name = table ? (*table)["name"].value<std::string>() : std::nullopt;
    if (name && (*name == part || quoted(*name) == part)) return i;
  }
  return std::nullopt;
}

/// Where a case that builds on the one of `place`, or an override, changed something of a value in braces.
toml::source_region place_of_change(const toml::node& value, const toml::source_region& place) {
  const toml::table* braces = value.as_table();
  if (!braces || !braces->is_inline() || !place.path) return place;
  toml::source_region found = place;
  for (const auto& [key, inner] : *braces) {
    if (!key.source().path || *key.source().path == *place.path) continue;
    found = key.source();
    if (found.path->starts_with(override_option)) break;  // the last word
  }
  return found;
}

toml::source_region place_of(const toml::table& table, const std::string& path,
                             const toml::source_region& otherwise) {
  toml::source_region place = otherwise;
  const toml::node* node = &table;
  for (const auto& part : split_path(path)) {
    if (const toml::table* inner = node->as_table()) {
      const auto entry = inner->find(part);
      if (entry == inner->end()) return place;
      place = entry->first.source();
      node = &entry->second;
    } else if (const toml::array* items = node->as_array()) {
      const auto index = item_index(*items, part);
      if (!index) return place;
      node = items->get(*index);
      if (node->source().path) place = node->source();
    } else {
      return place;
    }
  }
  return place_of_change(*node, place);
}

std::string json_text(const toml::node& node) {
  std::ostringstream text;
  text << toml::json_formatter(
      node, toml::json_formatter::default_flags & ~toml::format_flags::quote_infinities_and_nans);
  return text.str();
}

std::string found(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return fmt::format("the text \"{}\"", *text);
  if (const auto integer = node.value_exact<std::int64_t>()) return fmt::format("the number {}", *integer);
  if (const auto number = node.value_exact<double>()) return fmt::format("the number {}", *number);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  if (node.is_table()) return "a section";
  if (node.is_array_of_tables()) return "a list of sections";
  if (const auto* array = node.as_array(); array && !array->empty() && array->get(0)->is_array())
    return counted(array->size(), "row") + " of numbers";
  if (const auto* array = node.as_array()) return fmt::format("a list of {}", array->size());
  return "a date or time";
}

}  // namespace toryu
