#include "common/case/read_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <set>

#include "common/case/csv_file.hpp"
#include "common/case/nearest_word.hpp"
#include "common/case/rule_text.hpp"
#include "common/case/text_file.hpp"

namespace toryu {

ReadTable::ReadTable(const toml::table* table, std::string path, std::string where, toml::source_region place,
                     const Reading& reading)
    : table_(table),
      path_(std::move(path)),
      where_(std::move(where)),
      place_(std::move(place)),
      reading_(reading),
      faults_(reading.faults),
      faults_apart_(reading.faults.size()) {}

void ReadTable::number(const std::string& key, double& value, const NumberRule& rule) {
  const toml::node* node = find(key, rule.required, number_kind("a number", rule), rule.help);
  if (!node) return;
  if (const auto read = checked_number(key, *node, rule, place_of_key(key))) value = *read;
}

void ReadTable::integer(const std::string& key, int& value, const NumberRule& rule) {
  const std::string kind = number_kind("an integer", rule);
  const toml::node* node = find(key, rule.required, kind, rule.help);
  if (!node) return;
  if (!node->is_integer()) return wrong_type(key, kind, *node, place_of_key(key));
  const NumberRule representable{.minimum = INT_MIN, .maximum = INT_MAX};
  auto read = checked_number(key, *node, rule, place_of_key(key));
  if (read) read = checked_number(key, *node, representable, place_of_key(key));
  if (read) value = static_cast<int>(*read);
}

void ReadTable::flag(const std::string& key, bool& value, const std::string& help) {
  const toml::node* node = find(key, false, "true or false", help);
  if (!node) return;
  if (const auto read = node->value_exact<bool>())
    value = *read;
  else
    wrong_type(key, "true or false", *node, place_of_key(key));
}

void ReadTable::text(const std::string& key, std::string& value, const TextRule& rule) {
  const toml::node* node = find(key, rule.required, text_kind(rule.allowed), rule.help);
  if (!node) return;
  const auto read = checked_text(key, *node, rule.allowed, place_of_key(key));
  if (!read) return;
  if (rule.required && !rule.names_columns && read->empty())
    return fault(place_of_key(key), fmt::format("'{}'{} must not be empty", key, where_));
  if (rule.names_columns && (read->empty() || read->find_first_of(",;[]\"\n\r\t") != std::string::npos))
    return fault(place_of_key(key),
                 fmt::format("'{}'{} names columns of the results: it must not be empty nor hold any of , ; "
                             "[ ] \" or a line break, found '{}'",
                             key, where_, *read));
  value = *read;
}

void ReadTable::texts(const std::string& key, std::vector<std::string>& value, const TextRule& rule) {
  const std::string kind = texts_kind(rule.allowed);
  const toml::node* node = find(key, rule.required, kind, rule.help);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array) return wrong_type(key, kind, *node, place_of_key(key));
  std::vector<std::string> read;
  for (const auto& item : *array)
    if (const auto text = checked_text(key, item, rule.allowed, item.source())) read.push_back(*text);
  if (read.size() == array->size()) value = read;
}

void ReadTable::vector(const std::string& key, Vec& value, const NumberRule& rule) {
  const std::string kind = fmt::format("{} numbers{}", dim, unit_text(rule.unit));
  const toml::node* node = find(key, rule.required, kind, rule.help);
  if (!node) return;
  if (const auto read = checked_numbers(key, *node, dim, rule, kind, place_of_key(key)))
    value = Eigen::Map<const Vec>(read->data());
}

void ReadTable::rows(const std::string& key, std::vector<std::vector<double>>& value,
                     const std::vector<std::string>& columns, const TextRule& rule) {
  const std::string kind = rows_kind(columns);
  const toml::node* node = find(key, rule.required, kind, rule.help);
  if (!node) return;
  if (const auto file = node->value_exact<std::string>())
    return read_rows_of_file(key, *file, columns, value);
  if (auto read = checked_rows(key, *node, columns.size(), kind, place_of_key(key))) value = std::move(*read);
}

void ReadTable::tables(const std::string& key, std::vector<std::vector<std::vector<double>>>& value,
                       const std::vector<std::string>& columns, const TextRule& rule) {
  const std::string kind = "lists of " + rows_kind(columns);
  const toml::node* node = find(key, rule.required, kind, rule.help);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array) return wrong_type(key, kind, *node, place_of_key(key));
  std::vector<std::vector<std::vector<double>>> read;
  for (const auto& rows : *array)
    if (auto table = checked_rows(key, rows, columns.size(), kind, rows.source()))
      read.push_back(std::move(*table));
  if (read.size() == array->size()) value = std::move(read);
}

void ReadTable::file(const std::string& key, InputFile& value, const TextRule& rule) {
  const toml::node* node = find(key, rule.required, "a file", rule.help);
  if (!node) return;
  const auto name = checked_text(key, *node, {}, place_of_key(key));
  if (!name) return;
  if (const std::string wrong = fault_of_name(reading_.folder, *name); !wrong.empty())
    return fault(place_of_key(key), wrong);
  InputFile read{.name = *name, .path = reading_.folder / *name};
  try {
    read.text = read_text(read.path, largest_reference);
  } catch (const BadInput& error) {
    return fault(place_of_key(key), fmt::format("'{}' {}", *name, error.errors()[0].message));
  }
  value = std::move(read);
}

void ReadTable::read_rows_of_file(const std::string& key, const std::string& name,
                                  const std::vector<std::string>& columns,
                                  std::vector<std::vector<double>>& value) {
  std::optional<CsvFault> found;
  auto read = read_rows(reading_.folder, name, columns, found);
  if (!found)
    value = std::move(read);
  else if (found->line > 0)
    faults_.push_back({.place = (reading_.folder / name).string(),
                       .line = found->line,
                       .column = 1,
                       .message = found->message});
  else
    fault(place_of_key(key), found->message);
}

void ReadTable::word(const std::string& key, int& index, const std::vector<std::string>& words,
                     const TextRule& rule) {
  const toml::node* node = find(key, rule.required, text_kind(words), rule.help);
  if (!node) return;
  if (const auto read = checked_text(key, *node, words, place_of_key(key)))
    index = static_cast<int>(std::find(words.begin(), words.end(), *read) - words.begin());
}

bool ReadTable::section(const std::string& key, const SectionRule& rule,
                        const std::function<void(ParameterTable&)>& visit) {
  const toml::node* node = find(key, false, "a section", rule.help);
  if (!node) return rule.absence == Absence::takes_defaults;
  if (node->value_exact<bool>() == false) return false;
  const toml::table* table = node->as_table();
  if (table)
    read_section(table, key, visit);
  else
    wrong_type(key, "a section, or false to leave it out", *node, place_of_key(key));
  return table;
}

void ReadTable::required_section(const std::string& key, const std::string& help,
                                 const std::function<void(ParameterTable&)>& visit) {
  const toml::node* node = find(key, false, "a section", help);
  if (node && !node->is_table()) return wrong_type(key, "a section", *node, place_of_key(key));
  read_section(node ? node->as_table() : nullptr, key, visit);
}

void ReadTable::read_section(const toml::table* table, const std::string& key,
                             const std::function<void(ParameterTable&)>& visit) {
  const std::string path = path_of(key);
  ReadTable inner(table, path, " in [" + path + "]", table ? place_of_key(key) : place_, reading_);
  visit(inner);
  inner.report_unknown_keys();
}

void ReadTable::items(const std::string& key, std::size_t /*count*/, const std::string& help,
                      const std::function<void(std::size_t)>& resize,
                      const std::function<void(std::size_t, ParameterTable&)>& visit) {
  const std::string header = "[[" + path_of(key) + "]]";
  const toml::node* node = find(key, false, "a list of sections", help);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array) return wrong_type(key, "a list of sections " + header, *node, place_of_key(key));
  resize(array->size());
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& item = *array->get(i);
    const toml::source_region place = item.source().path ? item.source() : place_of_key(key);
    if (!item.is_table()) {
      wrong_type(key, "a list of sections " + header, item, place);
      continue;
    }
    ReadTable inner(item.as_table(), path_of(key), " in " + header, place, reading_);
    visit(i, inner);
    inner.report_unknown_keys();
  }
  require_names_differ(*array, header);
}

/// Two items of one name could be told apart neither in the results nor by a case that builds on this one.
void ReadTable::require_names_differ(const toml::array& items, const std::string& header) {
  std::set<std::string> names;
  for (const auto& item : items) {
    const toml::table* table = item.as_table();
    const auto name = table ? (*table)["name"].value_exact<std::string>() : std::nullopt;
    if (!name || name->empty() || names.insert(*name).second) continue;
    fault(table->find("name")->first.source(),
          fmt::format("two {} are named '{}'; names must differ", header, *name));
    ++faults_apart_;
  }
}

void ReadTable::require(bool holds, const std::string& key, const std::string& message) {
  if (holds || faults_.size() != faults_apart_) return;
  fault(table_ ? place_of(*table_, key, place_) : place_, message);
  ++faults_apart_;
}

void ReadTable::report_unknown_keys() {
  if (!table_) return;
  for (const auto& [key, node] : *table_) {
    const std::string typed(key.str());
    if (std::find(known_.begin(), known_.end(), typed) != known_.end()) continue;
    std::string hint = did_you_mean(typed, known_);
    if (hint.empty()) hint = known_.empty() ? ", which has no keys" : "; known are " + quoted_list(known_);
    fault(key.source(), fmt::format("unknown key '{}'{}{}", typed, where_, hint));
  }
}

const toml::node* ReadTable::find(const std::string& key, bool required, const std::string& kind,
                                  const std::string& help) {
  known_.push_back(key);
  const toml::node* node = table_ ? table_->get(key) : nullptr;
  if (!node && required)
    fault(place_,
          fmt::format("missing key '{}'{}: {}{}", key, where_, kind, help.empty() ? "" : ", " + help));
  return node;
}

toml::source_region ReadTable::place_of_key(const std::string& key) const {
  return table_->find(key)->first.source();
}

void ReadTable::fault(const toml::source_region& place, const std::string& message) {
  faults_.push_back(fault_at(place, message));
}

void ReadTable::wrong_type(const std::string& key, const std::string& kind, const toml::node& node,
                           const toml::source_region& place) {
  fault(place, fmt::format("'{}'{} must be {}, found {}", key, where_, kind, found(node)));
}

std::optional<double> ReadTable::checked_number(const std::string& key, const toml::node& node,
                                                const NumberRule& rule, const toml::source_region& place) {
  const std::string kind = number_kind("a number", rule);
  if (!node.is_number()) {
    wrong_type(key, kind, node, place);
    return std::nullopt;
  }
  const double value = *node.value<double>();
  if (!std::isfinite(value)) {
    fault(place, fmt::format("'{}'{} must be a finite number{}, found {}", key, where_, unit_text(rule.unit),
                             value));
    return std::nullopt;
  }
  if (!in_range(value, rule)) {
    fault(place, fmt::format("'{}'{} must be {}{}, found {}", key, where_, range_text(rule),
                             unit_text(rule.unit), value));
    return std::nullopt;
  }
  return value;
}

std::optional<std::string> ReadTable::checked_text(const std::string& key, const toml::node& node,
                                                   const std::vector<std::string>& allowed,
                                                   const toml::source_region& place) {
  auto value = node.value_exact<std::string>();
  if (!value) {
    wrong_type(key, text_kind(allowed), node, place);
    return std::nullopt;
  }
  if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), *value) == allowed.end()) {
    fault(place, fmt::format("'{}'{} must be one of {}, found '{}'{}", key, where_, quoted_list(allowed),
                             *value, did_you_mean(*value, allowed)));
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<double>> ReadTable::checked_numbers(const std::string& key, const toml::node& node,
                                                              std::size_t count, const NumberRule& rule,
                                                              const std::string& kind,
                                                              const toml::source_region& place) {
  const toml::array* array = node.as_array();
  const auto nested = [](const toml::node& item) { return item.is_array() || item.is_table(); };
  if (!array || array->size() != count || std::any_of(array->begin(), array->end(), nested)) {
    wrong_type(key, kind, node, place);
    return std::nullopt;
  }
  std::vector<double> values;
  for (const auto& item : *array)
    if (const auto value = checked_number(key, item, rule, item.source())) values.push_back(*value);
  if (values.size() != count) return std::nullopt;
  return values;
}

std::optional<std::vector<std::vector<double>>> ReadTable::checked_rows(const std::string& key,
                                                                        const toml::node& node,
                                                                        std::size_t columns,
                                                                        const std::string& kind,
                                                                        const toml::source_region& place) {
  const toml::array* array = node.as_array();
  if (!array) {
    wrong_type(key, kind, node, place);
    return std::nullopt;
  }
  std::vector<std::vector<double>> read;
  for (const auto& row : *array)
    if (const auto numbers = checked_numbers(key, row, columns, {}, kind, row.source()))
      read.push_back(*numbers);
  if (read.size() != array->size()) return std::nullopt;
  return read;
}

std::string ReadTable::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

}  // namespace toryu
