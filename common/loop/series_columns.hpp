/// The columns of the series that a run will write: judged before it begins, and told by `--check --columns`.
#pragma once

#include <string>
#include <vector>

#include "common/case/case_file.hpp"
#include "common/run/solver.hpp"
#include "common/scene/scene.hpp"

namespace toryu {

/// A file of the results, "fluid.csv", and the names of its columns.
struct SeriesColumns {
  std::string file;
  std::vector<std::string> names;
};

/// Of the series of `participant` ("fluid"), a row of which holds `observations` behind the time.
SeriesColumns series_columns(const std::string& participant, const std::vector<Observation>& observations);

/// Adds a fault of `file` if two of `observations`, of the participant with the section `section`, have one
/// name: at the item of which that column is, an observer before others.
void check_columns(CaseFile& file, const std::vector<Observation>& observations, const std::string& section);

/// Adds a fault of `file` for each reference over a series that no program of the case writes, or over a
/// column that `series` does not have.
void check_references(CaseFile& file, const Scene& scene, const SeriesColumns& series);

/// What `--columns` prints: FILE.csv:COLUMN, a line each.
std::string listed(const SeriesColumns& series);

}  // namespace toryu
