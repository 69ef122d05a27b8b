/// Numbers of things in sentences.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace toryu {

/// "1 step", "2 steps": `thing` takes an s unless there is one.
template <class Count>
std::string counted(Count count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == Count(1) ? "" : "s");
}

}  // namespace toryu
