/// The skin of neighbour lists: they reach further than the kernel, and hold every pair within its support
/// until both particles of a pair together may have moved by that margin.
#pragma once

#include "common/sph/points.hpp"

namespace toryu {

/// Largest |v| of the first `count` entries.
double largest_norm(const VecField& v, std::size_t count);

/// Largest distance between the first `count` points of both.
double largest_distance(const VecField& x, const VecField& y, std::size_t count);

/// Whether lists must be built anew where targets and sources may have moved so far since the last time [m].
inline bool skin_exhausted(double moved_targets, double moved_sources, double skin) {
  return moved_targets + moved_sources > skin;
}

}  // namespace toryu
