/// What a time step changes, kept to be put back.
#pragma once

#include <functional>
#include <tuple>

namespace toryu {

/// Copies `variables`; the function returned puts the copies back into them, as often as it is called.
template <class... T>
std::function<void()> snapshot(T&... variables) {
  return
      [present = std::tie(variables...), kept = std::tuple<T...>(variables...)]() mutable { present = kept; };
}

}  // namespace toryu
