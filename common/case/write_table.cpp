#include "common/case/write_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/rule_text.hpp"

namespace toryu {

namespace {

std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      result += c;
  }
  return result + "\"";
}

template <class Values, class Text>
std::string array_text(const Values& values, Text text) {
  std::string result;
  for (const auto& value : values) result += (result.empty() ? "" : ", ") + text(value);
  return "[" + result + "]";
}

std::string numbers_text(const std::vector<double>& values) {
  return array_text(values, number_text);
}

std::string rows_text(const std::vector<std::vector<double>>& rows) {
  return array_text(rows, numbers_text);
}

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

void WriteTable::number(const std::string& key, double& value, const NumberRule& /*rule*/) {
  if (std::isfinite(value)) add(key, number_text(value));
}

void WriteTable::integer(const std::string& key, int& value, const NumberRule& /*rule*/) {
  add(key, fmt::format("{}", value));
}

void WriteTable::flag(const std::string& key, bool& value, const std::string& /*help*/) {
  add(key, value ? "true" : "false");
}

void WriteTable::text(const std::string& key, std::string& value, const TextRule& /*rule*/) {
  add(key, in_quotes(value));
}

void WriteTable::texts(const std::string& key, std::vector<std::string>& value, const TextRule& /*rule*/) {
  add(key, array_text(value, in_quotes));
}

void WriteTable::vector(const std::string& key, Vec& value, const NumberRule& /*rule*/) {
  const std::vector<double> numbers(value.data(), value.data() + dim);
  if (finite(numbers)) add(key, numbers_text(numbers));
}

void WriteTable::rows(const std::string& key, std::vector<std::vector<double>>& value,
                      const std::vector<std::string>& /*columns*/, const TextRule& /*rule*/) {
  add(key, rows_text(value));
}

void WriteTable::tables(const std::string& key, std::vector<std::vector<std::vector<double>>>& value,
                        const std::vector<std::string>& /*columns*/, const TextRule& /*rule*/) {
  add(key, array_text(value, rows_text));
}

void WriteTable::file(const std::string& key, InputFile& value, const TextRule& /*rule*/) {
  add(key, in_quotes(value.name));
}

void WriteTable::word(const std::string& key, int& index, const std::vector<std::string>& words,
                      const TextRule& /*rule*/) {
  add(key, in_quotes(words.at(static_cast<std::size_t>(index))));
}

bool WriteTable::section(const std::string& key, const SectionRule& rule,
                         const std::function<void(ParameterTable&)>& visit) {
  if (rule.present)
    add_section("[" + path_of(key) + "]", path_of(key), visit);
  else if (rule.absence == Absence::takes_defaults)
    add(key, "false");
  return rule.present;
}

void WriteTable::required_section(const std::string& key, const std::string& /*help*/,
                                  const std::function<void(ParameterTable&)>& visit) {
  add_section("[" + path_of(key) + "]", path_of(key), visit);
}

void WriteTable::items(const std::string& key, std::size_t count, const std::string& /*help*/,
                       const std::function<void(std::size_t)>& /*resize*/,
                       const std::function<void(std::size_t, ParameterTable&)>& visit) {
  for (std::size_t i = 0; i < count; ++i)
    add_section("[[" + path_of(key) + "]]", path_of(key), [&](ParameterTable& table) { visit(i, table); });
}

void WriteTable::add_section(const std::string& header, const std::string& path,
                             const std::function<void(ParameterTable&)>& visit) {
  WriteTable inner(path);
  visit(inner);
  sections_ += "\n" + header + "\n" + inner.text();
}

std::string WriteTable::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

}  // namespace toryu
