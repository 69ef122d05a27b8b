#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/outline.hpp"

namespace toryu {

namespace {

using Ring = Outline::Ring;

/// Of the extent of a ring: what is nearer is the same place.
constexpr double same = 1e-12;

std::string text(const Vec& place) {
  return fmt::format("({:g}, {:g}) m", place[0], place[1]);
}

struct Edge {
  Vec a, b;
  std::size_t ring, number, edges;  ///< of which ring, and how many that has
  Vec low() const { return a.cwiseMin(b); }
  Vec high() const { return a.cwiseMax(b); }
  bool precedes(const Edge& other) const {
    return ring == other.ring && (number + 1) % edges == other.number;
  }
};

/// A place that two edges which share no corner have in common.
std::optional<Vec> common_place(const Edge& p, const Edge& q) {
  const Vec u = p.b - p.a, w = q.b - q.a;
  const double c = cross(u, w), scale = u.norm() * w.norm();
  if (std::abs(c) > same * scale) {
    const double s = cross(q.a - p.a, w) / c, t = cross(q.a - p.a, u) / c;
    return s >= 0 && s <= 1 && t >= 0 && t <= 1 ? std::optional<Vec>(p.a + s * u) : std::nullopt;
  }
  if (std::abs(cross(q.a - p.a, u)) > same * u.squaredNorm()) return std::nullopt;
  const Vec low = p.low().cwiseMax(q.low()), high = p.high().cwiseMin(q.high());
  return (low.array() <= high.array()).all() ? std::optional<Vec>(low) : std::nullopt;
}

std::optional<OutlineFault> fault_of(const Ring& ring, std::size_t number) {
  if (ring.size() < 3)
    return OutlineFault{fmt::format("has {} corners; an outline has at least 3", ring.size()), number, 0};
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (!ring[k].allFinite()) return OutlineFault{"has a corner that is no number", number, k};
  Vec low = ring[0], high = ring[0];
  for (const Vec& corner : ring) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double extent = (high - low).norm();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((b - a).norm() <= same * extent)
      return OutlineFault{fmt::format("has the corner {} twice", text(a)), number, k};
  }
  return std::nullopt;
}

bool has_area(const Ring& ring) {
  double area = 0, length = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec &a = ring[k], &b = ring[(k + 1) % ring.size()];
    area += 0.5 * cross(a - ring[0], b - ring[0]);
    length += (b - a).norm();
  }
  return std::abs(area) > same * length * length;
}

std::optional<Vec> meeting(const Edge& p, const Edge& q) {
  // A corner that turns right back meets the edge beyond.
  return p.precedes(q) || q.precedes(p) ? std::nullopt : common_place(p, q);
}

}  // namespace

std::optional<OutlineFault> fault_of(const std::vector<Ring>& rings) {
  if (rings.empty()) return OutlineFault{"has no ring", 0, 0};
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (auto fault = fault_of(rings[r], r)) return fault;
    for (std::size_t k = 0; k < rings[r].size(); ++k)
      edges.push_back({rings[r][k], rings[r][(k + 1) % rings[r].size()], r, k, rings[r].size()});
  }
  // In the order of their first x, so that each is tried only on those that begin before it ends.
  std::sort(edges.begin(), edges.end(), [](const Edge& p, const Edge& q) { return p.low()[0] < q.low()[0]; });
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low()[0] <= edges[i].high()[0]; ++j) {
      const Edge &p = edges[i], &q = edges[j];
      if (p.low()[1] > q.high()[1] || q.low()[1] > p.high()[1]) continue;
      if (const auto place = meeting(p, q))
        return OutlineFault{fmt::format("crosses or touches itself at {}", text(*place)), p.ring, p.number};
    }
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (!has_area(rings[r])) return OutlineFault{"encloses no area", r, 0};
  return std::nullopt;
}

}  // namespace toryu
