/// Tables in files beside a case: comma-separated values under a line of names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace toryu {

/// What is wrong with a file; line 0: with the file as a whole, of which the case tells.
struct CsvFault {
  int line = 0;
  std::string message;
};

/// Rows of the columns ("time [s]") of a file beside the case, whose first line names them in any order and
/// with or without blanks ("time[s]"); other columns are left alone. If `fault` is set, it is empty.
std::vector<std::vector<double>> read_rows(const std::filesystem::path& folder, const std::string& name,
                                           const std::vector<std::string>& columns,
                                           std::optional<CsvFault>& fault);

}  // namespace toryu
