#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/scene/outline.hpp"

namespace toryu {

namespace {

using Ring = Outline::Ring;
using Segment = std::pair<std::size_t, std::size_t>;  ///< of numbered places

/// Numbered places; two that are nearer than a tolerance are one.
class Places {
 public:
  explicit Places(double tolerance) : tolerance_(tolerance) {}
  std::size_t number(const Vec& x) {
    const Cell at = cell(x);
    for (long b = -1; b <= 1; ++b)
      for (long a = -1; a <= 1; ++a)
        if (const auto found = cells_.find({at.first + a, at.second + b}); found != cells_.end())
          if ((places_[found->second] - x).norm() < tolerance_) return found->second;
    cells_.emplace(at, places_.size());
    places_.push_back(x);
    return places_.size() - 1;
  }
  const Vec& operator[](std::size_t number) const { return places_[number]; }

 private:
  using Cell = std::pair<long, long>;
  Cell cell(const Vec& x) const { return {std::lround(x[0] / tolerance_), std::lround(x[1] / tolerance_)}; }
  double tolerance_;
  std::map<Cell, std::size_t> cells_;
  std::vector<Vec> places_;
};

/// The edges of `outline`, cut where those of `other` meet them.
std::vector<Segment> cut_edges(const Outline& outline, const Outline& other, double tolerance,
                               Places& places) {
  std::vector<Segment> segments;
  for (const Ring& ring : outline.rings())
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec &a = ring[k], &b = ring[(k + 1) % ring.size()], u = b - a;
      std::vector<double> cuts{0.0, 1.0};
      const auto cut_at = [&](const Vec& x) {  // if it lies on the edge
        const double t = (x - a).dot(u) / u.squaredNorm();
        if (t > 0 && t < 1 && (a + t * u - x).norm() < tolerance) cuts.push_back(t);
      };
      for (const Ring& cutting : other.rings())
        for (std::size_t m = 0; m < cutting.size(); ++m) {
          const Vec &p = cutting[m], &q = cutting[(m + 1) % cutting.size()];
          cut_at(p);
          const double side_p = cross(u, p - a), side_q = cross(u, q - a);
          if ((side_p > 0) == (side_q > 0)) continue;
          cut_at(p + side_p / (side_p - side_q) * (q - p));
        }
      std::sort(cuts.begin(), cuts.end());
      for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
        const Segment segment{places.number(a + cuts[c] * u), places.number(a + cuts[c + 1] * u)};
        if (segment.first != segment.second) segments.push_back(segment);
      }
    }
  return segments;
}

/// Joins segments end to end. Where several go on from a place, the one most to the left, so that rings that
/// share a corner stay apart.
std::vector<Ring> chained(const std::vector<Segment>& segments, const Places& places) {
  std::multimap<std::size_t, std::size_t> from;
  for (const auto& [a, b] : segments) from.emplace(a, b);
  std::vector<Ring> rings;
  while (!from.empty()) {
    auto next = from.begin();
    const std::size_t start = next->first;
    std::size_t here = start;
    Ring ring;
    while (true) {
      const std::size_t there = next->second;
      const Vec way = places[there] - places[here];
      ring.push_back(places[here]);
      from.erase(next);
      here = there;
      if (here == start) break;
      const auto [first, last] = from.equal_range(here);
      if (first == last) break;  // rounding at a sliver: closed as it is
      next = std::max_element(first, last, [&](const auto& p, const auto& q) {
        const auto turn = [&](std::size_t to) {
          const Vec on = places[to] - places[here];
          return std::atan2(cross(way, on), way.dot(on));
        };
        return turn(p.second) < turn(q.second);
      });
    }
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

std::vector<Ring> difference(const Outline& outline, const Outline& hole) {
  const Box bounds = outline.bounds();
  const double tolerance = 1e-9 * (bounds.max - bounds.min).norm();
  Places places(tolerance);
  const auto own = cut_edges(outline, hole, tolerance, places);
  const auto of_hole = cut_edges(hole, outline, tolerance, places);
  const std::set<Segment> own_set(own.begin(), own.end()), hole_set(of_hole.begin(), of_hole.end());
  const auto middle = [&](const Segment& s) -> Vec { return 0.5 * (places[s.first] + places[s.second]); };
  const auto turned = [](const Segment& s) { return Segment{s.second, s.first}; };
  std::vector<Segment> kept;
  for (const Segment& s : own)  // what both have is kept where they lie on different sides of it
    if (hole_set.contains(turned(s)) || (!hole_set.contains(s) && !hole.contains(middle(s))))
      kept.push_back(s);
  for (const Segment& s : of_hole)
    if (!own_set.contains(s) && !own_set.contains(turned(s)) && outline.contains(middle(s)))
      kept.push_back(turned(s));
  return chained(kept, places);
}

}  // namespace toryu
