/// The skin of neighbour lists: they reach further than the kernel, and hold every pair within its support
/// until both particles of a pair together may have moved by that margin.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/sph/points.hpp"

namespace toryu {

/// Largest |v| of the first `count` entries.
inline double largest_norm(const VecField& v, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, at(v, i).squaredNorm());
  return std::sqrt(largest);
}

/// Largest distance between the first `count` points of both.
inline double largest_distance(const VecField& x, const VecField& y, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, (at(x, i) - at(y, i)).squaredNorm());
  return std::sqrt(largest);
}

/// Whether lists must be built anew where targets and sources may have moved so far since the last time [m].
inline bool skin_exhausted(double moved_targets, double moved_sources, double skin) {
  return moved_targets + moved_sources > skin;
}

}  // namespace toryu
