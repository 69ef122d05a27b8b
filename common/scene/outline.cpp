#include "common/scene/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace toryu {

namespace {

constexpr std::uint32_t edges_of_leaf = 4;

/// Positive if anticlockwise [m2].
double signed_area(const Outline::Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    sum += cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
  return 0.5 * sum;
}

/// Whether the ray from x towards positive x crosses an edge. The ends are sorted first, so that an edge
/// answers the same whichever way round it is.
bool ray_crosses(const Vec& x, const Vec& a, const Vec& b) {
  const Vec &low = a[1] < b[1] ? a : b, &high = a[1] < b[1] ? b : a;
  return low[1] <= x[1] && x[1] < high[1] && cross(high - low, x - low) > 0;
}

bool contains(const Outline::Ring& ring, const Vec& x) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k)
    inside ^= ray_crosses(x, ring[k], ring[(k + 1) % ring.size()]);
  return inside;
}

Box bounds_of(const Outline::Ring& ring) {
  Box box{ring[0], ring[0]};
  for (const Vec& corner : ring) {
    box.min = box.min.cwiseMin(corner);
    box.max = box.max.cwiseMax(corner);
  }
  return box;
}

double square_of_distance(const Vec& x, const Vec& low, const Vec& high) {
  return (low - x).cwiseMax(x - high).cwiseMax(Vec::Zero()).squaredNorm();
}

}  // namespace

Vec Outline::Edge::normal() const {
  return outward(a, b);
}

Outline::Outline(std::vector<Ring> rings) : rings_(std::move(rings)) {
  std::vector<Box> bounds;
  for (const Ring& ring : rings_) bounds.push_back(bounds_of(ring));
  std::vector<char> hole;
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    // Rings may share a corner, so that the middle of an edge tells.
    const Vec place = 0.5 * (rings_[k][0] + rings_[k][1]);
    bool inside = false;
    for (std::size_t other = 0; other < rings_.size(); ++other)
      if (other != k && bounds[other].contains(place)) inside ^= toryu::contains(rings_[other], place);
    hole.push_back(inside);
  }
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    if ((signed_area(rings_[k]) < 0) != (hole[k] != 0)) std::reverse(rings_[k].begin(), rings_[k].end());
    add_edges(rings_[k]);
  }
  build(0, static_cast<std::uint32_t>(edges_.size()));
}

void Outline::add_edges(const Ring& ring) {
  const std::size_t n = ring.size();
  const auto corner = [&](std::size_t k) -> const Vec& { return ring[k % n]; };
  const auto mean_normal = [&](std::size_t k) -> Vec {  // at a corner
    const Vec before = outward(corner(k + n - 1), corner(k)), after = outward(corner(k), corner(k + 1));
    const Vec sum = before + after;
    return sum.norm() > 0 ? sum.normalized() : after;
  };
  for (std::size_t k = 0; k < n; ++k)
    edges_.push_back({corner(k), corner(k + 1), mean_normal(k), mean_normal(k + 1)});
}

void Outline::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t node = nodes_.size();
  constexpr double far = std::numeric_limits<double>::infinity();
  nodes_.push_back({Vec::Constant(far), Vec::Constant(-far), first, last});
  for (std::uint32_t k = first; k < last; ++k) {
    nodes_[node].low = nodes_[node].low.cwiseMin(edges_[k].a).cwiseMin(edges_[k].b);
    nodes_[node].high = nodes_[node].high.cwiseMax(edges_[k].a).cwiseMax(edges_[k].b);
  }
  if (last - first <= edges_of_leaf) return;
  const std::uint32_t middle = first + (last - first) / 2;
  build(first, middle);
  nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

template <class Wanted, class Take>
void Outline::visit(const Wanted& wanted, const Take& take) const {
  std::array<std::uint32_t, 64> open{};  // deeper than a tree of 2^32 edges
  std::size_t count = 1;
  while (count > 0) {
    const std::uint32_t index = open[--count];
    const Node& node = nodes_[index];
    if (!wanted(node)) continue;
    if (node.right == 0) {
      for (std::uint32_t k = node.first; k < node.last; ++k) take(edges_[k]);
      continue;
    }
    open[count++] = node.right;
    open[count++] = index + 1;
  }
}

Box Outline::bounds() const {
  return {nodes_[0].low, nodes_[0].high};
}

double Outline::area() const {
  double sum = 0;
  for (const Ring& ring : rings_) sum += signed_area(ring);
  return sum;
}

double Outline::length() const {
  double sum = 0;
  for (const Edge& edge : edges_) sum += (edge.b - edge.a).norm();
  return sum;
}

bool Outline::contains(const Vec& x) const {
  bool inside = false;
  visit([&](const Node& node) { return node.low[1] <= x[1] && x[1] < node.high[1] && x[0] <= node.high[0]; },
        [&](const Edge& edge) { inside ^= ray_crosses(x, edge.a, edge.b); });
  return inside;
}

Outline::Foot Outline::nearest(const Vec& x) const {
  double best = std::numeric_limits<double>::infinity();
  const Edge* of = nullptr;
  double share = 0;
  const auto try_edge = [&](const Edge& edge) {
    const Vec along = edge.b - edge.a;
    const double t = std::clamp((x - edge.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double square = (edge.a + t * along - x).squaredNorm();
    if (square >= best) return;
    best = square;
    of = &edge;
    share = t;
  };
  // The nearer child first, for its edges then rule out the other.
  const auto descend = [&](const auto& self, std::uint32_t index) -> void {
    const Node& node = nodes_[index];
    if (square_of_distance(x, node.low, node.high) >= best) return;
    if (node.right == 0) {
      for (std::uint32_t k = node.first; k < node.last; ++k) try_edge(edges_[k]);
      return;
    }
    const Node &left = nodes_[index + 1], &right = nodes_[node.right];
    const bool left_first =
        square_of_distance(x, left.low, left.high) <= square_of_distance(x, right.low, right.high);
    self(self, left_first ? index + 1 : node.right);
    self(self, left_first ? node.right : index + 1);
  };
  descend(descend, 0);

  const double sign = contains(x) ? -1.0 : 1.0;
  Foot foot{of->a + share * (of->b - of->a), of->normal(), sign * std::sqrt(best)};
  const bool at_corner = share == 0.0 || share == 1.0;
  if (at_corner) {
    foot.place = share == 0.0 ? of->a : of->b;
    const double length = (of->b - of->a).norm();
    foot.normal = std::abs(foot.distance) > 1e-9 * length ? Vec((x - foot.place) / foot.distance)
                  : share == 0.0                          ? of->normal_a
                                                          : of->normal_b;
  }
  return foot;
}

std::vector<Outline::Share> Outline::shares_inside(const Vec& a, const Vec& b) const {
  const Vec way = b - a, low = a.cwiseMin(b), high = a.cwiseMax(b);
  std::vector<double> crossings;
  visit(
      [&](const Node& node) {
        return (node.low.array() <= high.array()).all() && (node.high.array() >= low.array()).all();
      },
      [&](const Edge& edge) {
        const double side_a = cross(way, edge.a - a), side_b = cross(way, edge.b - a);
        if ((side_a > 0) == (side_b > 0)) return;
        const Vec place = edge.a + side_a / (side_a - side_b) * (edge.b - edge.a);
        const double t = (place - a).dot(way) / way.squaredNorm();
        if (t > 0 && t < 1) crossings.push_back(t);
      });
  std::sort(crossings.begin(), crossings.end());
  crossings.push_back(1.0);
  std::vector<Share> shares;
  double from = 0;
  for (const double to : crossings) {
    // Each part tells for itself: at a corner that the way grazes, crossings need not come in pairs.
    const bool inside = to > from && contains(a + 0.5 * (from + to) * way);
    if (inside && !shares.empty() && shares.back().second == from)
      shares.back().second = to;
    else if (inside)
      shares.emplace_back(from, to);
    from = to;
  }
  return shares;
}

Outline Outline::moved(const Vec& by) const {
  Outline copy = *this;
  for (Ring& ring : copy.rings_)
    for (Vec& corner : ring) corner += by;
  for (Edge& edge : copy.edges_) edge.a += by, edge.b += by;
  for (Node& node : copy.nodes_) node.low += by, node.high += by;
  return copy;
}

bool Box::in_outline(const Vec& x) const {
  return outline->contains(x);
}

Box Box::moved(const Vec& by) const {
  Box box{min + by, max + by, round};
  if (outline) box.outline = std::make_shared<const Outline>(outline->moved(by));
  return box;
}

std::vector<Vec> corners_of(const Box& box) {
  constexpr int round_corners = 64;
  std::vector<Vec> corners;
  if (box.outline) {
    for (const Outline::Ring& ring : box.outline->rings())
      corners.insert(corners.end(), ring.begin(), ring.end());
    return corners;
  }
  if (!box.round) return ring_of(box);
  for (int k = 0; k < round_corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / round_corners;
    const Vec half = 0.5 * (box.max - box.min), middle = 0.5 * (box.max + box.min);
    corners.emplace_back(middle + half.cwiseProduct(Vec(std::cos(angle), std::sin(angle))));
  }
  return corners;
}

Box box_of(Outline outline) {
  Box box = outline.bounds();
  box.outline = std::make_shared<const Outline>(std::move(outline));
  return box;
}

Outline::Ring ellipse_ring(const Vec& centre, const Vec& radii, int corners) {
  const double step = 2 * std::numbers::pi / corners;
  const double grown = std::sqrt(step / std::sin(step));
  Outline::Ring ring;
  for (int k = 0; k < corners; ++k)
    ring.push_back(centre + grown * radii.cwiseProduct(Vec(std::cos(k * step), std::sin(k * step))));
  return ring;
}

Outline::Ring ring_of(const Box& box) {
  if (box.round) return ellipse_ring(0.5 * (box.min + box.max), 0.5 * (box.max - box.min));
  return {box.min, Vec(box.max[0], box.min[1]), box.max, Vec(box.min[0], box.max[1])};
}

Outline outline_of(const Box& box) {
  return box.outline ? *box.outline : Outline({ring_of(box)});
}

}  // namespace toryu
