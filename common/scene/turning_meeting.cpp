#include "common/scene/turning_meeting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/scene/outline.hpp"

namespace toryu {

namespace {

using Polygon = std::vector<Vec>;  ///< convex, its corners anticlockwise

constexpr double most_looks = 1e5;

Polygon outer_corners(const Part& part) {
  return corners_of(part.within.size() == 1 ? part.within.front() : bounds_of(part));
}

bool is_convex(const Polygon& corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec &a = corners[k], &b = corners[(k + 1) % corners.size()], &c = corners[(k + 2) % corners.size()];
    if (cross(b - a, c - b) < 0) return false;
  }
  return true;
}

/// Whether its corners say all of it.
bool is_polygon(const Part& part) {
  if (!part.without.empty()) return false;
  if (part.within.size() != 1 || !part.within.front().outline) return true;
  return part.within.front().outline->rings().size() == 1 && is_convex(corners_of(part.within.front()));
}

Polygon placed(const Polygon& outline, const Pose& pose) {
  Polygon moved;
  for (const Vec& X : outline) moved.push_back(pose.place(X));
  return moved;
}

Pose pose_of(const Motion* motion, double t) {
  return motion ? motion->pose_at(t) : Pose();
}

/// How far the one reaches into the other: the least along the normals of the sides of `a` [m].
double depth_behind_sides(const Polygon& a, const Polygon& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec normal = outward(a[k], a[(k + 1) % a.size()]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec& x : b) nearest = std::min(nearest, normal.dot(x - a[k]));
    least = std::min(least, -nearest);
  }
  return least;
}

/// The mean of the corners of what both share.
Vec shared_place(const Polygon& a, const Polygon& b) {
  Polygon left = b;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec along = a[(k + 1) % a.size()] - a[k], inward(-along[1], along[0]);
    Polygon kept;
    for (std::size_t n = 0; n < left.size(); ++n) {
      const Vec &x = left[n], &y = left[(n + 1) % left.size()];
      const double x_in = inward.dot(x - a[k]), y_in = inward.dot(y - a[k]);
      if (x_in >= 0) kept.push_back(x);
      if (x_in * y_in < 0) kept.emplace_back(x + x_in / (x_in - y_in) * (y - x));
    }
    if (kept.empty()) break;
    left = kept;
  }
  Vec mean = Vec::Zero();
  for (const Vec& x : left) mean += x / static_cast<double>(left.size());
  return mean;
}

/// The circle that holds the corners.
struct Disc {
  Vec middle = Vec::Zero();  ///< [m]
  double radius = 0;         ///< [m]
  explicit Disc(const Polygon& corners) {
    for (const Vec& x : corners) middle += x / static_cast<double>(corners.size());
    for (const Vec& x : corners) radius = std::max(radius, (x - middle).norm());
  }
};

/// Looks at both, by look(t, pose of a, pose of b), whenever either may have moved by `tolerance` and the
/// circles that hold them overlap, until a look finds something.
template <class Look>
std::optional<Meeting> first_look(const Pair& pair, double tolerance, double end_time, const Look& look) {
  const Polygon a = outer_corners(pair.a), b = outer_corners(pair.b);
  const Disc around_a(a), around_b(b);
  double fastest = 0;
  std::vector<double> times{0, end_time};
  for (const auto& [motion, outline] : {std::pair(pair.motion_a, &a), std::pair(pair.motion_b, &b)})
    if (motion) {
      fastest += extremes(*motion, *outline, end_time).speed;
      for (const double t : motion->knots(end_time)) times.push_back(t);
    }
  std::sort(times.begin(), times.end());
  const double step = std::max(tolerance / fastest, end_time / most_looks);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double length = times[k] - times[k - 1];
    const int looks = std::max(1, static_cast<int>(std::ceil(length / step)));
    for (int n = 0; n < looks; ++n) {
      const double t = times[k - 1] + n * length / looks;
      const Pose pose_a = pose_of(pair.motion_a, t), pose_b = pose_of(pair.motion_b, t);
      const double apart = (pose_a.place(around_a.middle) - pose_b.place(around_b.middle)).norm();
      if (apart > around_a.radius + around_b.radius) continue;
      if (auto found = look(t, pose_a, pose_b)) return found;
    }
  }
  return {};
}

}  // namespace

bool can_turn_with(const Pair& pair) {
  return is_polygon(pair.a) && is_polygon(pair.b);
}

bool may_meet_turning(const Pair& pair, double tolerance, double end_time) {
  const auto near = [](double t, const Pose&, const Pose&) { return std::optional(Meeting{t, Vec::Zero()}); };
  return first_look(pair, tolerance, end_time, near).has_value();
}

std::optional<Meeting> first_turning_meeting(const Pair& pair, double tolerance, double end_time) {
  const Polygon a = outer_corners(pair.a), b = outer_corners(pair.b);
  const auto look = [&](double t, const Pose& pose_a, const Pose& pose_b) -> std::optional<Meeting> {
    const Polygon a_now = placed(a, pose_a), b_now = placed(b, pose_b);
    if (std::min(depth_behind_sides(a_now, b_now), depth_behind_sides(b_now, a_now)) <= tolerance) return {};
    return Meeting{t, shared_place(a_now, b_now)};
  };
  return first_look(pair, tolerance, end_time, look);
}

}  // namespace toryu
