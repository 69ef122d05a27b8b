/// Axis-aligned boxes, and the ellipses in them.
#pragma once

#include "common/vector.hpp"

namespace toryu {

/// An axis-aligned box [m], or the disc (the ellipse, if its sides differ) that touches its sides: the shapes
/// of which bodies are made. A body is a list of them, less a list of holes; a ring is a disc with a disc cut
/// out.
struct Box {
  Vec min = Vec::Zero();
  Vec max = Vec::Zero();
  bool round = false;
  bool contains(const Vec& x) const {
    return (x.array() >= min.array()).all() && (x.array() < max.array()).all() && (!round || in_ellipse(x));
  }
  bool in_ellipse(const Vec& x) const {
    return ((2.0 * x - min - max).array() / (max - min).array()).matrix().squaredNorm() < 1.0;
  }
};

}  // namespace toryu
