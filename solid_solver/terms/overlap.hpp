/// How much of a kernel a half plane of particles fills: what contact forces measure depth by.
#pragma once

#include <cmath>

#include "common/sph/kernel.hpp"

namespace toryu {

/// Sum of V W over a half plane of particles whose uppermost row is `distance` [m] below, and the largest
/// slope of it [1/m].
struct HalfPlane {
  double sum = 0, slope = 0;
};
inline HalfPlane half_plane(const CubicSpline& W, double spacing, double distance) {
  const double V = spacing * spacing;
  HalfPlane found;
  for (double y = distance; y < W.support(); y += spacing)
    for (double x = -std::ceil(W.support() / spacing) * spacing; x <= W.support(); x += spacing) {
      const double r = std::hypot(x, y);
      found.sum += V * W.value(r);
      found.slope -= V * W.gradient_over_r(r, 1.0 / r) * y;
    }
  return found;
}

}  // namespace toryu
