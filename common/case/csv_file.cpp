#include "common/case/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/csv_rows.hpp"
#include "common/case/input_file.hpp"
#include "common/case/nearest_word.hpp"
#include "common/case/text_file.hpp"
#include "common/error/counted.hpp"
#include "common/error/failure.hpp"

namespace toryu {

namespace {

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

}  // namespace

std::vector<std::vector<double>> read_rows(const std::filesystem::path& folder, const std::string& name,
                                           const std::vector<std::string>& columns,
                                           std::optional<CsvFault>& fault) {
  const auto refuse = [&](int line, const std::string& message) {
    fault = {line, message};
    return std::vector<std::vector<double>>();
  };
  if (const auto wrong = fault_of_name(folder, name); !wrong.empty()) return refuse(0, wrong);
  std::string text;
  try {
    text = read_text(folder / name, largest_reference);
  } catch (const BadInput& error) {
    return refuse(0, fmt::format("'{}' {}", name, error.errors()[0].message));
  }
  CsvRows lines(text);
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
      return refuse(lines.line, counted(lines.cells.size(), "cell") + " in a row under " +
                                    counted(heads.size(), "column"));
    auto& row = rows.emplace_back();
    for (const std::size_t place : places) {
      const auto value = csv_number(lines.cells[place]);
      if (!value || std::isnan(*value))
        return refuse(lines.line,
                      fmt::format("'{}' is no number, in the column '{}'", lines.cells[place], heads[place]));
      row.push_back(*value);
    }
  }
  return rows;
}

}  // namespace toryu
