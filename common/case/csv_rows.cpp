#include "common/case/csv_rows.hpp"

#include <charconv>
#include <cmath>

namespace toryu {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The cells of a line. A cell may stand in quotes, within which a comma parts nothing and "" is a quote.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool two_quotes = quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (two_quotes)
      cells.back() += line[i++];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  }
  for (auto& cell : cells) cell = trimmed(cell);
  return cells;
}

}  // namespace

bool CsvRows::next() {
  for (std::string text; std::getline(stream_, text);) {
    ++line;
    if (text.starts_with('#') || trimmed(text).empty()) continue;
    cells = cells_of(text);
    return true;
  }
  return false;
}

std::optional<double> csv_number(const std::string& cell) {
  if (cell.empty()) return NAN;
  const char* const end = cell.data() + cell.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(cell.data() + (cell[0] == '+'), end, value);
  if (error == std::errc::result_out_of_range) return NAN;
  if (error != std::errc() || rest != end) return std::nullopt;
  return std::isfinite(value) ? value : NAN;
}

bool has_other_comma(const std::vector<std::string>& cells) {
  return cells.size() == 1 && cells[0].find_first_of(";\t") != std::string::npos;
}

}  // namespace toryu
