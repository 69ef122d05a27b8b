#include "common/case/rule_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "common/case/nearest_word.hpp"

namespace toryu {

std::string unit_text(const std::string& unit) {
  return unit.empty() || unit == "1" ? "" : fmt::format(" [{}]", unit);
}

std::string range_text(const NumberRule& rule) {
  const bool from = std::isfinite(rule.minimum), to = std::isfinite(rule.maximum);
  if (from && to)
    return rule.above_minimum ? fmt::format("above {} and up to {}", rule.minimum, rule.maximum)
                              : fmt::format("from {} to {}", rule.minimum, rule.maximum);
  if (from) return fmt::format("{} {}", rule.above_minimum ? "above" : "at least", rule.minimum);
  if (to) return fmt::format("at most {}", rule.maximum);
  return "";
}

std::string number_kind(const std::string& kind, const NumberRule& rule) {
  const std::string range = range_text(rule);
  if (range.empty()) return kind + unit_text(rule.unit);
  return fmt::format("{}{} {}{}", kind, unit_text(rule.unit), range.starts_with("at") ? "of " : "", range);
}

std::string text_kind(const std::vector<std::string>& allowed) {
  return allowed.empty() ? "text" : "one of " + quoted_list(allowed);
}

std::string texts_kind(const std::vector<std::string>& allowed) {
  return "a list of " + (allowed.empty() ? "texts" : quoted_list(allowed));
}

std::string rows_kind(const std::vector<std::string>& columns) {
  return fmt::format("rows of {} numbers ({})", columns.size(), fmt::join(columns, ", "));
}

bool in_range(double value, const NumberRule& rule) {
  const bool low_enough = value <= rule.maximum;
  return low_enough && (rule.above_minimum ? value > rule.minimum : value >= rule.minimum);
}

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace toryu
