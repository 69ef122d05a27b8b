/// Axis-aligned boxes, and what lies in them: ellipses and outlines.
#pragma once

#include <memory>

#include "common/vector.hpp"

namespace toryu {

class Outline;

/// An axis-aligned box [m], the disc (the ellipse, if its sides differ) that touches its sides, or the inside
/// of an outline of which it is the bounds: the shapes of which bodies are made. A body is a list of them,
/// less a list of holes.
struct Box {
  Vec min = Vec::Zero();
  Vec max = Vec::Zero();
  bool round = false;
  std::shared_ptr<const Outline> outline = {};
  bool contains(const Vec& x) const {
    return (x.array() >= min.array()).all() && (x.array() < max.array()).all() && (!round || in_ellipse(x)) &&
           (!outline || in_outline(x));
  }
  /// Whether there is something between its corners.
  bool is_sound() const { return (max.array() > min.array()).all(); }
  /// Whether it fills its corners.
  bool is_rectangle() const { return !round && !outline; }
  bool in_ellipse(const Vec& x) const {
    return ((2.0 * x - min - max).array() / (max - min).array()).matrix().squaredNorm() < 1.0;
  }
  bool in_outline(const Vec& x) const;
  /// The same shape elsewhere [m].
  Box moved(const Vec& by) const;
};

}  // namespace toryu
