#include "solid_solver/shape.hpp"

#include <algorithm>
#include <cmath>

#include "common/scene/outline.hpp"

namespace toryu::solid {

namespace {

/// Over the spacing: rounding, what is known of a round face, and by how much a bond may be longer than the
/// straight way.
constexpr double rounding = 1e-6, round_face = 0.25, longest_detour = 0.1;
/// Cosine of the turn from which on a corner is one.
constexpr double least_straight = 0.98;

/// The part of the way a + t (b - a), 0 <= t <= 1, that lies in a box; empty where end <= begin.
struct Part {
  double begin = 0, end = 1;
};

Part part_in_sides(const Box& box, const Vec& a, const Vec& way) {
  Part part;
  for (int axis = 0; axis < dim; ++axis) {
    if (way[axis] == 0) {
      if (a[axis] < box.min[axis] || a[axis] > box.max[axis]) return {0, 0};
      continue;
    }
    const double first = (box.min[axis] - a[axis]) / way[axis],
                 second = (box.max[axis] - a[axis]) / way[axis];
    part.begin = std::max(part.begin, std::min(first, second));
    part.end = std::min(part.end, std::max(first, second));
  }
  return part;
}

Part part_in_ellipse(const Box& box, const Vec& a, const Vec& way) {
  const Vec radii = 0.5 * (box.max - box.min);
  const Vec from = (a - 0.5 * (box.min + box.max)).cwiseQuotient(radii), along = way.cwiseQuotient(radii);
  const double A = along.squaredNorm(), B = from.dot(along), D = B * B - A * (from.squaredNorm() - 1);
  if (!(A > 0) || D <= 0) return {0, 0};
  return {std::max(0.0, (-B - std::sqrt(D)) / A), std::min(1.0, (-B + std::sqrt(D)) / A)};
}

/// Calls take(part) for each part of the way from a that lies in a shape.
template <class Take>
void parts_in(const Box& box, const Vec& a, const Vec& way, const Take& take) {
  if (box.outline)
    for (const auto& [begin, end] : box.outline->shares_inside(a, a + way)) take(Part{begin, end});
  else if (const Part part = box.round ? part_in_ellipse(box, a, way) : part_in_sides(box, a, way);
           part.end > part.begin)
    take(part);
}

/// Box with its sides moved out by `distance` [m]. Particles know an outline as it is.
Box grown(const Box& box, double distance) {
  if (box.outline) return box;
  return {box.min.array() - distance, box.max.array() + distance, box.round};
}

/// Corners at which an outline turns by more than a curve in small steps does.
void add_corners(const Outline& outline, std::vector<Vec>& corners) {
  for (const auto& ring : outline.rings())
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec before = (ring[k] - ring[(k + ring.size() - 1) % ring.size()]).normalized(),
                after = (ring[(k + 1) % ring.size()] - ring[k]).normalized();
      if (before.dot(after) < least_straight) corners.push_back(ring[k]);
    }
}

}  // namespace

Shape::Shape(std::vector<Box> regions, std::vector<Box> holes, double spacing)
    : regions_(std::move(regions)), tolerance_(rounding * spacing), detour_(longest_detour * spacing) {
  for (const auto* boxes : {&regions_, &holes})
    for (const Box& box : *boxes)
      if (box.outline)
        add_corners(*box.outline, corners_);
      else if (!box.round)
        for (const double x : {box.min.x(), box.max.x()})
          for (const double y : {box.min.y(), box.max.y()}) corners_.emplace_back(x, y);
  for (Box& region : regions_) region = grown(region, region.round ? round_face * spacing : 0.5 * tolerance_);
  for (const Box& hole : holes) {
    const Box smaller = grown(hole, hole.round ? -round_face * spacing : -0.5 * tolerance_);
    if ((smaller.max.array() > smaller.min.array()).all()) holes_.push_back(smaller);
  }
}

bool Shape::joins(const Vec& a, const Vec& b) const {
  if (is_convex() || sees(a, b)) return true;
  // Round a re-entrant corner, where the kernel sees what is as good as in sight.
  const double longest = (b - a).norm() + detour_;
  return std::any_of(corners_.begin(), corners_.end(), [&](const Vec& corner) {
    return (corner - a).norm() + (b - corner).norm() < longest && sees(a, corner) && sees(corner, b);
  });
}

bool Shape::sees(const Vec& a, const Vec& b) const {
  const Vec way = b - a;
  if (way.norm() <= tolerance_) return true;
  const double share = tolerance_ / way.norm();
  double empty = 0;  // the longest way through a hole
  for (const Box& hole : holes_)
    parts_in(hole, a, way, [&](const Part& part) { empty = std::max(empty, part.end - part.begin); });
  if (empty > share) return false;
  std::vector<Part> parts;
  for (const Box& region : regions_)
    parts_in(region, a, way, [&](const Part& part) { parts.push_back(part); });
  std::sort(parts.begin(), parts.end(), [](const Part& p, const Part& q) { return p.begin < q.begin; });
  double reached = 0;
  for (const Part& part : parts)
    if (part.begin <= reached + share) reached = std::max(reached, part.end);
  return reached >= 1 - share;
}

}  // namespace toryu::solid
