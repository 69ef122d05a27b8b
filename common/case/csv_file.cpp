#include "common/case/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/case/nearest_word.hpp"
#include "common/case/text_file.hpp"
#include "common/error/failure.hpp"

namespace toryu {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

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

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

}  // namespace

bool CsvLines::next() {
  for (std::string text; std::getline(stream_, text);) {
    ++line;
    if (text.starts_with('#') || trimmed(text).empty()) continue;
    cells = cells_of(text);
    return true;
  }
  return false;
}

std::optional<double> number_in(const std::string& cell) {
  if (cell.empty()) return NAN;
  const char* const end = cell.data() + cell.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(cell.data() + (cell[0] == '+'), end, value);
  if (error == std::errc::result_out_of_range) return NAN;
  if (error != std::errc() || rest != end) return std::nullopt;
  return std::isfinite(value) ? value : NAN;
}

std::optional<std::string> fault_of_path(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path path(name);
  for (const auto& part : path)
    if (path.is_absolute() || part == "..")
      return fmt::format("'{}' must lie in the folder of the case", name);
  if (!is_file(folder / path)) return fmt::format("no file '{}' in the folder of the case", name);
  return std::nullopt;
}

std::vector<std::vector<double>> read_rows(const std::filesystem::path& folder, const std::string& name,
                                           const std::vector<std::string>& columns,
                                           std::optional<CsvFault>& fault) {
  const auto refuse = [&](int line, const std::string& message) {
    fault = {line, message};
    return std::vector<std::vector<double>>();
  };
  if (const auto wrong = fault_of_path(folder, name)) return refuse(0, *wrong);
  std::string text;
  try {
    text = read_text(folder / name, largest_reference);
  } catch (const BadInput& error) {
    return refuse(0, fmt::format("'{}' {}", name, error.errors()[0].message));
  }
  CsvLines lines(text);
  if (!lines.next()) return refuse(0, fmt::format("'{}' is empty", name));
  std::vector<std::string> heads;
  for (const auto& cell : lines.cells) heads.push_back(without_blanks(cell));
  std::vector<std::size_t> places;
  for (const auto& column : columns) {
    const auto found = std::find(heads.begin(), heads.end(), without_blanks(column));
    if (found == heads.end())
      return refuse(lines.line, fmt::format("no column '{}'; the columns are {}", without_blanks(column),
                                            quoted_list(heads)));
    places.push_back(static_cast<std::size_t>(found - heads.begin()));
  }
  std::vector<std::vector<double>> rows;
  while (lines.next()) {
    if (lines.cells.size() != heads.size())
      return refuse(lines.line,
                    fmt::format("{} cells in a row under {} columns", lines.cells.size(), heads.size()));
    auto& row = rows.emplace_back();
    for (const std::size_t place : places) {
      const auto value = number_in(lines.cells[place]);
      if (!value || std::isnan(*value))
        return refuse(lines.line,
                      fmt::format("'{}' is no number, in the column '{}'", lines.cells[place], heads[place]));
      row.push_back(*value);
    }
  }
  return rows;
}

}  // namespace toryu
