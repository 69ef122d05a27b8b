#include "solid_solver/total_lagrangian/clamp_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace toryu::solid {

namespace {

constexpr double rounding = 1e-9;

/// The share of the way from `from` to `to` at which it enters the box of `sides` about `centre`; infinity if
/// it passes by. A way along a side, to rounding, passes by.
double entry(const Vec& from, const Vec& to, const Vec& centre, const Vec& sides) {
  double in = 0, out = 1;
  for (int a = 0; a < dim; ++a) {
    const double way = to[a] - from[a], middle = centre[a] - from[a], half = 0.5 * sides[a];
    if (std::abs(way) < rounding * sides[a]) {
      if (std::abs(middle) > (1 - rounding) * half) return std::numeric_limits<double>::infinity();
      continue;
    }
    in = std::max(in, (middle - std::copysign(half, way)) / way);
    out = std::min(out, (middle + std::copysign(half, way)) / way);
  }
  return out - in > rounding ? in : std::numeric_limits<double>::infinity();
}

/// The same for the cell of what is nearer to `centre` than to any of `others`.
double entry(const Vec& from, const Vec& to, const Vec& centre, const std::vector<Vec>& others) {
  double in = 0, out = 1;
  for (const Vec& other : others) {
    // |x - centre|^2 <= |x - other|^2 at x = from + s (to - from)
    const Vec apart = centre - other;
    const double rise = (to - from).dot(apart), level = (0.5 * (centre + other) - from).dot(apart);
    if (std::abs(rise) < rounding * apart.squaredNorm()) {
      if (level > -rounding * apart.squaredNorm()) return std::numeric_limits<double>::infinity();
    } else if (rise > 0)
      in = std::max(in, level / rise);
    else
      out = std::min(out, level / rise);
  }
  return out - in > rounding ? in : std::numeric_limits<double>::infinity();
}

std::uint64_t key(std::size_t free, std::size_t held) {
  return (static_cast<std::uint64_t>(free) << 32) | held;
}

}  // namespace

ClampFaces::ClampFaces(const VecField& X, std::size_t count, const Held& held, const ClusterList& neighbours,
                       double reach)
    : held_(held) {
  for (std::size_t i = 0; i < count; ++i)
    if (!holds(i)) find_shares(X, i, neighbours.near(i / lane_count), reach);
}

void ClampFaces::find_shares(const VecField& X, std::size_t i, std::span<const ShiftedNeighbours> neighbours,
                             double reach) {
  const Vec X_i = at(X, i);
  struct Place {
    std::uint32_t j;
    Vec X;
  };
  std::vector<Place> near;  // of i itself: the same whichever cluster it is in
  std::vector<Vec> free;    // of those about it, where cells follow from them
  for (const auto& [shift, sources] : neighbours)
    for (const std::uint32_t j : sources) {
      const Vec X_j = at(X, j) - shift;
      if (!((X_j - X_i).norm() < reach)) continue;
      if (holds(j))
        near.push_back({j, X_j});
      else if (held_.fitted)
        free.push_back(X_j);
    }
  for (const auto& [j, X_j] : near) {
    double s = 1;
    for (const auto& [k, X_k] : near)
      s = std::min(s, held_.fitted ? entry(X_i, X_j, X_k, free) : entry(X_i, X_j, X_k, at(held_.cells, k)));
    shares_[key(i, j)] = s;
  }
}

std::optional<double> ClampFaces::share(std::size_t i, std::size_t j) const {
  if (!holds(i) && !holds(j)) return std::nullopt;
  if (holds(i) && holds(j)) return 0.0;
  const auto found = shares_.find(holds(j) ? key(i, j) : key(j, i));
  return found == shares_.end() ? 1.0 : found->second;
}

}  // namespace toryu::solid
