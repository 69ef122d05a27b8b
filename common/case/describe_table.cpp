#include "common/case/describe_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/case/nearest_word.hpp"
#include "common/case/rule_text.hpp"

namespace toryu {

void DescribeTable::number(const std::string& key, double& value, const NumberRule& rule) {
  add(key, rule.required, fmt::format("{}", value), number_kind("a number", rule), rule.help);
}

void DescribeTable::integer(const std::string& key, int& value, const NumberRule& rule) {
  add(key, rule.required, fmt::format("{}", value), number_kind("an integer", rule), rule.help);
}

void DescribeTable::flag(const std::string& key, bool& value, const std::string& help) {
  add(key, false, value ? "true" : "false", "true or false", help);
}

void DescribeTable::text(const std::string& key, std::string& value, const TextRule& rule) {
  add(key, rule.required, "'" + value + "'", text_kind(rule.allowed), rule.help);
}

void DescribeTable::texts(const std::string& key, std::vector<std::string>& value, const TextRule& rule) {
  add(key, rule.required, "[" + quoted_list(value) + "]", texts_kind(rule.allowed), rule.help);
}

void DescribeTable::vector(const std::string& key, Vec& value, const NumberRule& rule) {
  const std::vector<double> numbers(value.data(), value.data() + dim);
  add(key, rule.required, value.allFinite() ? fmt::format("[{}]", fmt::join(numbers, ", ")) : "none",
      number_kind(fmt::format("{} numbers", dim), rule), rule.help);
}

void DescribeTable::rows(const std::string& key, std::vector<std::vector<double>>& value,
                         const std::vector<std::string>& columns, const TextRule& rule) {
  add(key, rule.required, fmt::format("{}", value), rows_kind(columns), rule.help);
}

void DescribeTable::tables(const std::string& key, std::vector<std::vector<std::vector<double>>>& value,
                           const std::vector<std::string>& columns, const TextRule& rule) {
  add(key, rule.required, fmt::format("{}", value), "lists of " + rows_kind(columns), rule.help);
}

void DescribeTable::file(const std::string& key, InputFile& value, const TextRule& rule) {
  add(key, rule.required, "'" + value.name + "'", "a file in the folder of the case", rule.help);
}

void DescribeTable::word(const std::string& key, int& index, const std::vector<std::string>& words,
                         const TextRule& rule) {
  add(key, rule.required, "'" + words.at(static_cast<std::size_t>(index)) + "'", text_kind(words), rule.help);
}

bool DescribeTable::section(const std::string& key, const SectionRule& rule,
                            const std::function<void(ParameterTable&)>& visit) {
  const char* absence = rule.absence == Absence::leaves_out ? "(optional)" : "(taken unless false)";
  add_section(fmt::format("[{}]  {}", path_of(key), absence), key, rule.help, visit);
  return rule.present;
}

void DescribeTable::required_section(const std::string& key, const std::string& help,
                                     const std::function<void(ParameterTable&)>& visit) {
  add_section("[" + path_of(key) + "]", key, help, visit);
}

void DescribeTable::items(const std::string& key, std::size_t /*count*/, const std::string& help,
                          const std::function<void(std::size_t)>& /*resize*/,
                          const std::function<void(std::size_t, ParameterTable&)>& visit) {
  // No list has an item of this number, so the pattern of an item is described.
  constexpr std::size_t pattern = static_cast<std::size_t>(-1);
  add_section("[[" + path_of(key) + "]]  (any number)", key, help,
              [&](ParameterTable& table) { visit(pattern, table); });
}

std::string DescribeTable::text() const {
  std::array<std::size_t, 3> widths{};
  for (const auto& row : keys_)
    for (std::size_t c = 0; c < widths.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const auto& row : keys_) {
    std::string line = fmt::format("  {:{}}  {:{}}  {:{}}  {}", row[0], widths[0], row[1], widths[1], row[2],
                                   widths[2], row[3]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text + sections_;
}

void DescribeTable::add(const std::string& key, bool required, const std::string& initial,
                        const std::string& allowed, const std::string& help) {
  keys_.push_back({key, required ? "required" : initial, allowed, help});
}

void DescribeTable::add_section(const std::string& title, const std::string& key, const std::string& help,
                                const std::function<void(ParameterTable&)>& visit) {
  DescribeTable inner(path_of(key));
  visit(inner);
  sections_ += fmt::format("\n{}{}\n{}", title, help.empty() ? "" : "  " + help, inner.text());
}

std::string DescribeTable::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

}  // namespace toryu
