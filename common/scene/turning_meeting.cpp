#include "common/scene/turning_meeting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toryu {

namespace {

using Outline = std::vector<Vec>;  ///< corners, anticlockwise

constexpr double most_looks = 1e5;

Outline outline_of(const Part& part) {
  return corners_of(part.within.size() == 1 ? part.within.front() : bounds_of(part));
}

Outline placed(const Outline& outline, const Pose& pose) {
  Outline moved;
  for (const Vec& X : outline) moved.push_back(pose.place(X));
  return moved;
}

Pose pose_of(const Motion* motion, double t) {
  return motion ? motion->pose_at(t) : Pose();
}

/// How far the one reaches into the other: the least along the normals of the sides of `a` [m].
double depth_behind_sides(const Outline& a, const Outline& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec along = (a[(k + 1) % a.size()] - a[k]).normalized(), outward(along[1], -along[0]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec& x : b) nearest = std::min(nearest, outward.dot(x - a[k]));
    least = std::min(least, -nearest);
  }
  return least;
}

/// The mean of the corners of what both share.
Vec shared_place(const Outline& a, const Outline& b) {
  Outline left = b;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec along = a[(k + 1) % a.size()] - a[k], inward(-along[1], along[0]);
    Outline kept;
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

}  // namespace

bool can_turn_with(const Pair& pair) {
  return pair.a.without.empty() && pair.b.without.empty();
}

std::optional<Meeting> first_turning_meeting(const Pair& pair, double tolerance, double end_time) {
  const Outline a = outline_of(pair.a), b = outline_of(pair.b);
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
      const Outline a_now = placed(a, pose_of(pair.motion_a, t)),
                    b_now = placed(b, pose_of(pair.motion_b, t));
      if (std::min(depth_behind_sides(a_now, b_now), depth_behind_sides(b_now, a_now)) > tolerance)
        return Meeting{t, shared_place(a_now, b_now)};
    }
  }
  return {};
}

}  // namespace toryu
