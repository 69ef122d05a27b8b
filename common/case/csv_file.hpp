/// Tables in files beside a case: comma-separated values under a line of names.
#pragma once

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace toryu {

/// The lines of a text that say something, with their cells; # starts a comment. A cell may stand in quotes,
/// within which a comma parts nothing and "" is a quote.
class CsvLines {
 public:
  explicit CsvLines(const std::string& text) : stream_(text) {}
  bool next();
  int line = 0;
  std::vector<std::string> cells;

 private:
  std::istringstream stream_;
};

/// A finite number; NaN for a gap; nothing for any other text.
std::optional<double> number_in(const std::string& cell);

/// What is wrong with a path in a case, before the file is read: it lies in the case's folder.
std::optional<std::string> fault_of_path(const std::filesystem::path& folder, const std::string& name);

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
