/// The rows of a CSV file that a case names.
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace toryu {

/// The lines of a text that say something, one after the other: those that are empty or start with # do not.
class CsvRows {
 public:
  explicit CsvRows(const std::string& text) : stream_(text) {}
  bool next();
  int line = 0;                    ///< of the text, from 1
  std::vector<std::string> cells;  ///< a cell may stand in quotes, in which a comma parts nothing

 private:
  std::istringstream stream_;
};

/// A finite number; NaN for a gap; nothing for any other text.
std::optional<double> csv_number(const std::string& cell);

/// Whether the columns are parted by something else than a comma.
bool has_other_comma(const std::vector<std::string>& cells);

}  // namespace toryu
