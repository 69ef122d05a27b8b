/// Closed polygons: the outline of a body of any shape.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/box.hpp"

namespace toryu {

static_assert(dim == 2, "rings of the plane");

/// Closed polygons in the plane [m]: outer rings anticlockwise, holes clockwise. Material lies on the left of
/// each edge. Queries take a time that hardly depends on the number of corners: a tree of boxes holds the
/// edges in the order of the rings.
class Outline {
 public:
  using Ring = std::vector<Vec>;  ///< corners; the last is joined to the first
  /// Turns the rings the right way round: one that lies in an odd number of others is a hole.
  explicit Outline(std::vector<Ring> rings);

  const std::vector<Ring>& rings() const { return rings_; }
  Box bounds() const;
  double area() const;    ///< [m2]
  double length() const;  ///< of all rings [m]
  Outline moved(const Vec& by) const;
  /// Whether a point lies in the shape. One on an edge that two outlines share lies in exactly one of them,
  /// and one on an edge along x or y counts as in a box.
  bool contains(const Vec& x) const;

  struct Foot {
    Vec place;        ///< [m]
    Vec normal;       ///< outward; at a corner towards x
    double distance;  ///< [m]; below 0 inside
  };
  Foot nearest(const Vec& x) const;  ///< the point of the outline that is nearest to x

  using Share = std::pair<double, double>;  ///< from, to
  /// The parts of the way a + t (b - a), 0 <= t <= 1, that lie in the shape, in order.
  std::vector<Share> shares_inside(const Vec& a, const Vec& b) const;

 private:
  struct Edge {
    Vec a, b;
    Vec normal_a, normal_b;  ///< outward at its ends: the mean of the two edges there
    Vec normal() const;
  };
  /// The box of a row of edges; children are the next node and `right`, leaves have no right one.
  struct Node {
    Vec low, high;
    std::uint32_t first, last, right = 0;
  };
  void add_edges(const Ring& ring);
  void build(std::uint32_t first, std::uint32_t last);
  /// Calls take(edge) for the edges of all leaves whose boxes and whose parents' boxes are `wanted`.
  template <class Wanted, class Take>
  void visit(const Wanted& wanted, const Take& take) const;

  std::vector<Ring> rings_;
  std::vector<Edge> edges_;
  std::vector<Node> nodes_;
};

/// What is wrong with rings that should be an outline.
struct OutlineFault {
  std::string message;
  std::size_t ring, corner;  ///< from which the edge there comes, counted from 0
};
/// The first fault: fewer than three corners, a corner that is there twice, a ring without an area, edges
/// that cross or touch.
std::optional<OutlineFault> fault_of(const std::vector<Outline::Ring>& rings);

/// The rings of what is left of an outline without a hole; edges may be shared. None if nothing is.
std::vector<Outline::Ring> difference(const Outline& outline, const Outline& hole);

/// The unit normal of an edge from a to b, outward.
inline Vec outward(const Vec& a, const Vec& b) {
  return Vec(b[1] - a[1], a[0] - b[0]).normalized();
}

/// An ellipse as a ring, whose corners lie so far outside that the area is the ellipse's.
Outline::Ring ellipse_ring(const Vec& centre, const Vec& radii, int corners = 512);
/// The corners of a box, of an outline, or of the polygon with 64 corners in an ellipse, outer ones first and
/// anticlockwise [m].
std::vector<Vec> corners_of(const Box& box);
/// What lies within an outline, as a shape of a body.
Box box_of(Outline outline);
/// The corners of a box, or the ellipse in it if it is round.
Outline::Ring ring_of(const Box& box);
/// Of a shape that is one, or of a box or an ellipse.
Outline outline_of(const Box& box);

}  // namespace toryu
