/// Rules of parameters in words, the same in error messages and in the description of a case.
#pragma once

#include <string>

#include "common/case/parameter_table.hpp"

namespace toryu {

/// " [kg/m3]", or nothing for a number without unit.
std::string unit_text(const std::string& unit);
/// "above 0 and up to 1", "at least 0", or nothing if any number is allowed.
std::string range_text(const NumberRule& rule);
/// "a number [kg/m3] above 0", with `kind` "a number".
std::string number_kind(const std::string& kind, const NumberRule& rule);
/// "one of 'a', 'b'", or "text" if any text is allowed.
std::string text_kind(const std::vector<std::string>& allowed);
/// "a list of 'a', 'b'", or "a list of texts".
std::string texts_kind(const std::vector<std::string>& allowed);
/// "rows of 2 numbers (x [m], y [m])"
std::string rows_kind(const std::vector<std::string>& columns);
bool in_range(double value, const NumberRule& rule);
/// The shortest text that reads back as the same number, with a point or an exponent.
std::string number_text(double value);

}  // namespace toryu
