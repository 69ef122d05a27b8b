/// The points of a reference, read from its file in the folder of the case.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/error/failure.hpp"

namespace toryu {

/// A measured or published curve that the report draws over a series of this run.
struct Reference {
  std::string label;
  std::string file;    ///< CSV beside the case; lines that start with # are comments
  std::string series;  ///< "solid.csv:tip_displacement_x[m]"
  std::string column;  ///< column of `file`; its first column is time [s]
};

struct Curve {
  std::vector<double> time;   ///< [s]
  std::vector<double> value;  ///< in the unit of the column
};

/// What is wrong with a reference.
struct ReferenceFault {
  std::string key;  ///< of the reference
  std::string message;
  int line = 0;  ///< of its file, if the fault lies there
};

/// Reads the curve of `reference`, whose path is relative to `folder`. Cells that are empty or `nan` are
/// gaps. Returns the first fault instead if there is one, into `fault`.
Curve read_curve(const std::filesystem::path& folder, const Reference& reference,
                 std::optional<ReferenceFault>& fault);

/// What is wrong with the name of the series, FILE.csv:COLUMN.
std::optional<ReferenceFault> fault_of_series(const Reference& reference);

/// Why a file of this name cannot be copied beside the results; empty if it can.
std::string fault_of_results_name(const std::string& name);

/// Whether a run writes a file of this path, relative to the folder of the results.
bool is_written_by_runs(const std::filesystem::path& path);

}  // namespace toryu
