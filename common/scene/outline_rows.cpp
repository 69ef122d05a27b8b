#include <algorithm>
#include <cmath>

#include "common/scene/fill_outline.hpp"
#include "common/scene/place_index.hpp"

namespace toryu {

namespace {

using Ring = Outline::Ring;

/// A corner that turns by more is one that rows have too [rad]; what turns less is a curve.
constexpr double sharp_turn = 0.4;
/// Over the spacing: samples of a curve, how near points may be, and how far away room for another begins.
constexpr double sample = 1.0 / 16, too_near = 0.7, room = 0.85;

/// A place on a curve parallel to a ring.
struct Sample {
  Vec place;
  bool corner = false;  ///< where a point must be
};

/// The curve at `depth` inside a ring, in order; parts of it may lie outside the shape or nearer to it.
std::vector<Sample> offset_curve(const Ring& ring, double depth, double step) {
  std::vector<Sample> samples;
  const std::size_t n = ring.size();
  const auto normal = [&](std::size_t k) { return outward(ring[k % n], ring[(k + 1) % n]); };
  for (std::size_t k = 0; k < n; ++k) {
    const Vec before = normal(k + n - 1), here = normal(k), after = normal(k + 1), &corner = ring[k];
    const auto turn = [](const Vec& p, const Vec& q) { return std::atan2(cross(p, q), p.dot(q)); };
    const double turned = turn(before, here);
    if (turned > sharp_turn)  // the rows meet at a point
      samples.push_back({corner - depth / (1 + before.dot(here)) * (before + here), true});
    else if (turned < -sharp_turn) {  // and go round this one
      const int steps = 1 + static_cast<int>(-turned * depth / step);
      const double angle = std::atan2(before[1], before[0]);
      for (int m = 0; m <= steps; ++m) {
        const double phi = angle + turned * m / steps;
        samples.push_back({corner - depth * Vec(std::cos(phi), std::sin(phi))});
      }
    }
    // Along a curve the normal turns from corner to corner.
    const bool smooth_begin = std::abs(turned) <= sharp_turn,
               smooth_end = std::abs(turn(here, after)) <= sharp_turn;
    const Vec first = smooth_begin ? (before + here).normalized() : here,
              last = smooth_end ? (here + after).normalized() : here;
    const Vec edge = ring[(k + 1) % n] - corner;
    const int steps = 1 + static_cast<int>(edge.norm() / step);
    for (int m = 0; m < steps; ++m) {
      const double t = (m + 0.5) / steps;
      samples.push_back({corner + t * edge - depth * ((1 - t) * first + t * last).normalized()});
    }
  }
  return samples;
}

/// Takes points that no other is too near to.
class Gathering {
 public:
  Gathering(const Box& bounds, double spacing) : spacing_(spacing), index_(bounds, spacing) {}
  bool has_within(const Vec& x, double distance) const {
    bool found = false;
    index_.about(x, [&](std::uint32_t k) { found = found || (points_[k] - x).norm() < distance; });
    return found;
  }
  void take(const Vec& x) {
    if (has_within(x, too_near * spacing_)) return;
    index_.add(x, static_cast<std::uint32_t>(points_.size()));
    points_.push_back(x);
  }
  std::vector<Vec> points() && { return std::move(points_); }

 private:
  double spacing_;
  PlaceIndex index_;
  std::vector<Vec> points_;
};

/// Places points at equal distances, near to `spacing`, along a part of a curve. An end that is a corner has
/// a point; from another the first is half a distance away.
void place_along(const std::vector<Sample>& part, double spacing, Gathering& gathering) {
  std::vector<double> at{0.0};
  for (std::size_t k = 1; k < part.size(); ++k)
    at.push_back(at.back() + (part[k].place - part[k - 1].place).norm());
  const double length = at.back(), half_begin = part.front().corner ? 0.0 : 0.5,
               half_end = part.back().corner ? 0.0 : 0.5;
  if (!(length > 0)) return gathering.take(part.front().place);
  const double missing = 1 - half_begin - half_end;  // of as many distances as there are points
  const double count = std::max(1.0, std::round(length / spacing + missing));
  if (count <= missing) return gathering.take(part.front().place);
  const double distance = length / (count - missing);
  std::size_t k = 1;
  for (double m = 0; m < count; ++m) {
    const double s = (m + half_begin) * distance;
    while (k + 1 < at.size() && at[k] < s) ++k;
    const double share = at[k] > at[k - 1] ? std::min(1.0, (s - at[k - 1]) / (at[k] - at[k - 1])) : 0.0;
    gathering.take(part[k - 1].place + share * (part[k].place - part[k - 1].place));
  }
}

/// Cuts a closed curve at its corners and where it has gaps, and places points along each part.
void place_on_curve(const std::vector<Sample>& curve, double spacing, Gathering& gathering) {
  const std::size_t n = curve.size();
  const auto gap_after = [&](std::size_t k) {
    return (curve[(k + 1) % n].place - curve[k % n].place).norm() > 0.5 * spacing;
  };
  std::size_t start = 0;
  while (start < n && !curve[start].corner && !gap_after(start + n - 1)) ++start;
  const bool closed = start == n;
  std::vector<Sample> part{curve[start % n]};
  for (std::size_t m = 1; m <= n; ++m) {
    const std::size_t k = (start + m) % n;
    const bool gap = gap_after(start + m - 1);
    if (!gap) part.push_back(curve[k]);
    const bool ends = gap || m == n || (curve[k].corner && !closed);
    if (!ends) continue;
    place_along(part, spacing, gathering);
    part = {curve[k]};
  }
}

/// Puts a point wherever the rows leave room for one.
void fill_gaps(const Outline& outline, double spacing, Gathering& gathering) {
  const double step = 0.25 * spacing;
  const Box bounds = outline.bounds();
  for (double y = bounds.min[1] + 0.5 * step; y < bounds.max[1]; y += step)
    for (double x = bounds.min[0] + 0.5 * step; x < bounds.max[0]; x += step)
      if (const Vec place(x, y); !gathering.has_within(place, room * spacing) && outline.contains(place) &&
                                 outline.nearest(place).distance < -0.5 * spacing)
        gathering.take(place);
}

}  // namespace

std::vector<Vec> parallel_rows(const Outline& outline, double spacing) {
  Gathering gathering(outline.bounds(), spacing);
  bool any = true;
  for (double depth = 0.5 * spacing; any; depth += spacing) {
    any = false;
    for (const Ring& ring : outline.rings()) {
      auto curve = offset_curve(ring, depth, sample * spacing);
      // Where the ring turns back on itself a corner's place is no number, and within nothing.
      std::erase_if(curve, [&](const Sample& at) {
        return !(outline.nearest(at.place).distance <= -depth * (1 - 1e-3));
      });
      if (curve.empty()) continue;
      any = true;
      place_on_curve(curve, spacing, gathering);
    }
  }
  fill_gaps(outline, spacing, gathering);
  return std::move(gathering).points();
}

}  // namespace toryu
