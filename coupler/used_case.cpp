#include "coupler/used_case.hpp"

#include <set>
#include <sstream>

namespace toryu::coupling {

namespace {

/// "fluid" of "[fluid.region]" and of "[[fluid.region]]"; empty for other lines.
std::string top_level_section(const std::string& line) {
  const auto start = line.find_first_not_of('[');
  if (start == 0 || start == std::string::npos) return "";
  return line.substr(start, line.find_first_of(".]", start) - start);
}

}  // namespace

std::string merge_used_cases(const std::vector<std::string>& texts) {
  std::set<std::string> taken;  // sections of the texts before
  std::string merged;
  for (const std::string& text : texts) {
    std::set<std::string> here;
    bool skip = false;
    if (!merged.empty()) merged += '\n';
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (const std::string section = top_level_section(line); !section.empty()) {
        here.insert(section);
        skip = taken.count(section) > 0;
      }
      if (!skip) merged += line + '\n';
    }
    taken.merge(here);
  }
  return merged;
}

}  // namespace toryu::coupling
