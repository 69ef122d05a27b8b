#include "common/loop/series_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/case/nearest_word.hpp"
#include "common/error/failure.hpp"

namespace toryu {

namespace {

/// Whether `column` holds `name`, between its ends or underscores.
bool is_column_of(const std::string& column, const std::string& name) {
  return !name.empty() && fmt::format("_{}_", column).find(fmt::format("_{}_", name)) != std::string::npos;
}

/// The item with the longest name with which `column` begins, or that it holds, as a path to that name;
/// `section` if there is none.
std::string owner_of(const std::string& column, const CaseFile& file, const std::string& section) {
  std::string found = section;
  std::pair<bool, std::size_t> best{};
  for (const char* list : {".observer", ".region", ".body", ".inlet", ".outlet", "wall", "motion"}) {
    const std::string items = *list == '.' ? section + list : list;
    for (std::size_t k = 0; k < file.count(items); ++k) {
      const auto name = file.value<std::string>(fmt::format("{}[{}].name", items, k)).value_or("");
      const std::pair fit{column.starts_with(name + "_"), name.size()};
      if (!is_column_of(column, name) || fit <= best) continue;
      best = fit;
      found = fmt::format("{}.{}.name", items, k);
    }
  }
  return found;
}

}  // namespace

SeriesColumns series_columns(const std::string& participant, const std::vector<Observation>& observations) {
  SeriesColumns series{participant + ".csv", {"time[s]"}};
  for (const auto& observation : observations)
    series.names.push_back(fmt::format("{}[{}]", observation.name, observation.unit));
  return series;
}

void check_columns(CaseFile& file, const std::vector<Observation>& observations, const std::string& section) {
  std::set<std::string> names;
  for (const auto& observation : observations)
    if (!names.insert(observation.name).second)
      return file.fault(owner_of(observation.name, file, section),
                        fmt::format("two columns of the results would be named '{}': an observer, a region "
                                    "or a wall needs another name",
                                    observation.name));
}

void check_references(CaseFile& file, const Scene& scene, const SeriesColumns& series) {
  const bool coupled = file.has("fluid") && file.has("solid");
  for (std::size_t k = 0; k < scene.references.size(); ++k) {
    const std::string& meant = scene.references[k].series;
    const auto end = meant.find(".csv:");
    if (end == std::string::npos) continue;  // a fault that is told already
    const std::string of = meant.substr(0, end), column = meant.substr(end + 5);
    const std::string key = fmt::format("reference.{}.series", k);
    if (of == "coupler" ? !coupled : !file.has(of))
      file.fault(key, fmt::format("a run of this case writes no series '{}.csv'", of));
    if (of + ".csv" != series.file) continue;
    if (std::find(series.names.begin(), series.names.end(), column) == series.names.end())
      file.fault(key, fmt::format("{} will have no column '{}'{}", series.file, column,
                                  did_you_mean(column, series.names)));
  }
}

std::string listed(const SeriesColumns& series) {
  std::string text;
  for (const auto& name : series.names) text += fmt::format("{}:{}\n", series.file, name);
  return text;
}

}  // namespace toryu
