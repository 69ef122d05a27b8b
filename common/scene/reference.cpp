#include "common/scene/reference.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/case/csv_rows.hpp"
#include "common/case/input_file.hpp"
#include "common/case/nearest_word.hpp"
#include "common/case/text_file.hpp"
#include "common/error/counted.hpp"

namespace toryu {

namespace {

const std::vector<std::string> participants = {"fluid", "solid", "coupler"};

constexpr std::array results_files = {
#include "common/scene/results_files.inc"
};
/// By which runs keep to themselves, find each other and are stopped.
constexpr std::array control_files = {"run.lock", "launch.lock", "run.secret", "stop"};

std::string no_column(const Reference& reference, const std::vector<std::string>& columns) {
  const auto lacks_its_unit = [&](const std::string& column) {
    return column.starts_with(reference.column + "[");
  };
  const auto same = std::find_if(columns.begin(), columns.end(), lacks_its_unit);
  const std::string hint =
      same == columns.end() ? did_you_mean(reference.column, columns) : did_you_mean(*same, {*same});
  return fmt::format("no column '{}' in '{}'{}", reference.column, reference.file,
                     has_other_comma(columns) ? "; commas part its columns, and its numbers have points"
                     : hint.empty()           ? "; its columns are " + quoted_list(columns)
                                              : hint);
}

}  // namespace

Curve read_curve(const std::filesystem::path& folder, const Reference& reference,
                 std::optional<ReferenceFault>& fault) {
  const auto refuse = [&](const std::string& key, const std::string& message, int line = 0) {
    fault = {.key = key, .message = message, .line = line};
    return Curve{};
  };
  std::string wrong = fault_of_name(folder, reference.file);
  if (wrong.empty()) wrong = fault_of_results_name(reference.file);
  if (!wrong.empty()) return refuse("file", wrong);
  std::string text;
  try {
    text = read_text(folder / reference.file, largest_reference);
  } catch (const BadInput& error) {
    return refuse("file", fmt::format("'{}' {}", reference.file, error.errors()[0].message));
  }
  CsvRows rows(text);
  if (!rows.next()) return refuse("file", fmt::format("'{}' is empty", reference.file));
  const auto columns = rows.cells;
  const auto found = std::find(columns.begin(), columns.end(), reference.column);
  if (found == columns.end()) return refuse("column", no_column(reference, columns));
  if (std::find(found + 1, columns.end(), reference.column) != columns.end())
    return refuse("column", fmt::format("'{}' has two columns '{}'", reference.file, reference.column));
  const auto place = static_cast<std::size_t>(found - columns.begin());
  Curve curve;
  while (rows.next()) {
    if (rows.cells.size() != columns.size())
      return refuse(
          "file", counted(rows.cells.size(), "cell") + " in a row under " + counted(columns.size(), "column"),
          rows.line);
    for (const std::size_t k : {std::size_t{0}, place})
      if (!csv_number(rows.cells[k]))
        return refuse("file", fmt::format("'{}' is no number, in the column '{}'", rows.cells[k], columns[k]),
                      rows.line);
    const double time = *csv_number(rows.cells[0]), value = *csv_number(rows.cells[place]);
    if (std::isnan(time) || std::isnan(value)) continue;
    curve.time.push_back(time);
    curve.value.push_back(value);
  }
  if (curve.time.empty())
    return refuse("file",
                  fmt::format("'{}' holds no number in the column '{}'", reference.file, reference.column));
  return curve;
}

std::optional<ReferenceFault> fault_of_series(const Reference& reference) {
  const std::string& series = reference.series;
  const auto end = series.find(".csv:");
  if (end == std::string::npos)
    return ReferenceFault{.key = "series",
                          .message = fmt::format("'series' must be FILE.csv:COLUMN, such as "
                                                 "'solid.csv:tip_displacement_x[m]', found '{}'",
                                                 series)};
  const std::string name = series.substr(0, end);
  if (std::find(participants.begin(), participants.end(), name) != participants.end()) return std::nullopt;
  return ReferenceFault{.key = "series",
                        .message = fmt::format("no series '{}.csv'; there are {}{}", name,
                                               quoted_list(participants), did_you_mean(name, participants))};
}

std::string fault_of_results_name(const std::string& name) {
  if (!is_written_by_runs(name)) return "";
  return fmt::format(
      "'{}' is the name of a file of the results, beside which a copy of it is kept; give it another name or "
      "put it into a folder",
      name);
}

bool is_written_by_runs(const std::filesystem::path& path) {
  const auto normal = path.lexically_normal();
  const std::string first = normal.begin()->string();
  if (first == "frames" || first == "checkpoint") return true;
  std::string name = normal.string();
  if (name.ends_with(".part")) name.resize(name.size() - 5);
  const auto matches = [&](const char* pattern) { return fnmatch(pattern, name.c_str(), FNM_PATHNAME) == 0; };
  return std::any_of(results_files.begin(), results_files.end(), matches) ||
         std::any_of(control_files.begin(), control_files.end(), matches);
}

}  // namespace toryu
