/// Text from elsewhere (a case, another process), fit for a terminal and a file.
#pragma once

#include <string>
#include <string_view>

namespace toryu {

/// The text with escapes (\\x1b) for control characters, but for line breaks and tabs, and for what is not
/// UTF-8.
std::string printable(std::string_view text);

}  // namespace toryu
