#include "common/scene/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "common/scene/outline.hpp"
#include "common/scene/turning_meeting.hpp"

namespace toryu {

static_assert(dim == 2, "places are looked for in the plane");

namespace {

/// Into so many parts the extent of parts that are no boxes is cut, each edge of an outline at most, and the
/// time for which their bounds overlap.
constexpr int round_parts = 32;
/// Over a stretch of time: its last velocity is that before a jump at its end.
constexpr double before_jump = 1e-9;

/// An outline keeps its place: `holds` knows of the distance.
Box grown(const Box& box, double distance) {
  return {box.min.array() - distance, box.max.array() + distance, box.round, box.outline};
}

/// Whether a box that has been grown by `distance` has the point.
bool holds(const Box& grown, double distance, const Vec& x) {
  if (!grown.outline) return grown.contains(x);
  return (x.array() >= grown.min.array()).all() && (x.array() <= grown.max.array()).all() &&
         grown.outline->nearest(x).distance < distance;
}

Part joined(const Part& a, const Part& b, const Vec& a_by, const Vec& b_by) {
  Part both;
  for (const auto& [part, by] : {std::pair(&a, a_by), std::pair(&b, b_by)}) {
    for (const Box& box : part->within) both.within.push_back(by.isZero(0) ? box : box.moved(by));
    for (const Box& box : part->without) both.without.push_back(by.isZero(0) ? box : box.moved(by));
  }
  return both;
}

bool is_of_rectangles(const Part& part) {
  const auto is_rectangle = [](const Box& box) { return box.is_rectangle(); };
  return std::all_of(part.within.begin(), part.within.end(), is_rectangle) &&
         std::all_of(part.without.begin(), part.without.end(), is_rectangle);
}

/// Places along an outline, `depth` [m] to the left of its edges: inside, where it is above 0.
std::vector<Vec> places_along(const Outline& outline, double depth) {
  std::vector<Vec> places;
  for (const auto& ring : outline.rings())
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec &a = ring[k], way = ring[(k + 1) % ring.size()] - a;
      const Vec left = Vec(-way[1], way[0]).normalized() * depth;
      const int count = static_cast<int>(
          std::clamp(way.norm() / std::max(std::abs(depth), 1e-300), 1.0, double{round_parts}));
      for (int n = 0; n < count; ++n) places.emplace_back(a + (n + 0.5) / count * way + left);
    }
  return places;
}

/// Coordinates along `axis` of which one lies in each stretch between edges of boxes.
std::vector<double> samples(const Box& bounds, const std::vector<Box>& without, int axis, int cuts) {
  std::vector<double> edges{bounds.min[axis], bounds.max[axis]};
  for (const Box& box : without)
    for (const double edge : {box.min[axis], box.max[axis]})
      if (edge > bounds.min[axis] && edge < bounds.max[axis]) edges.push_back(edge);
  for (int k = 1; k < cuts; ++k)
    edges.push_back(bounds.min[axis] + k * (bounds.max[axis] - bounds.min[axis]) / cuts);
  std::sort(edges.begin(), edges.end());
  std::vector<double> middles;
  for (std::size_t k = 1; k < edges.size(); ++k)
    if (edges[k] > edges[k - 1]) middles.push_back(0.5 * (edges[k - 1] + edges[k]));
  return middles;
}

}  // namespace

Box bounds_of(const Part& part) {
  Box bounds = part.within.front();
  for (const Box& box : part.within)
    bounds = {bounds.min.cwiseMax(box.min), bounds.max.cwiseMin(box.max), false};
  return bounds;
}

std::optional<Vec> place_in(const Part& part, double tolerance) {
  Part firm;
  for (const Box& box : part.within) {
    firm.within.push_back(grown(box, -0.5 * tolerance));
    if (!firm.within.back().is_sound()) return {};
  }
  for (const Box& box : part.without) firm.without.push_back(grown(box, 0.5 * tolerance));
  const Box bounds = bounds_of(firm);
  if (!bounds.is_sound()) return {};
  const auto is_in = [&](const Vec& x) {
    const auto within = [&](const Box& box) { return holds(box, -0.5 * tolerance, x); };
    const auto without = [&](const Box& box) { return holds(box, 0.5 * tolerance, x); };
    return std::all_of(firm.within.begin(), firm.within.end(), within) &&
           std::none_of(firm.without.begin(), firm.without.end(), without);
  };
  const int cuts = is_of_rectangles(firm) ? 1 : round_parts;
  const auto ys = samples(bounds, firm.without, 1, cuts);
  for (const double x : samples(bounds, firm.without, 0, cuts))
    for (const double y : ys)
      if (is_in({x, y})) return Vec(x, y);
  // What two bodies share along a slanted or curved face is narrow, and begins at an outline.
  for (const auto& [boxes, depth] : {std::pair(&firm.within, 0.75), std::pair(&firm.without, -0.75)})
    for (const Box& box : *boxes)
      if (box.outline)
        for (const Vec& x : places_along(*box.outline, depth * tolerance))
          if (bounds.contains(x) && is_in(x)) return x;
  return {};
}

namespace {

/// A stretch of time in which both velocities are linear, or as good as that, and how the one body moves
/// against the other: r + v s + a s^2/2 at the time s from its beginning.
struct Stretch {
  double begin, length;  ///< [s]
  Vec r, v, a;           ///< [m], [m/s], [m/s2]
  Vec at(double s) const { return r + s * v + 0.5 * s * s * a; }
};

Vec velocity(const Motion* motion, double t) {
  return motion ? motion->velocity_at(t) : Vec(Vec::Zero());
}

Vec displacement(const Motion* motion, double t) {
  return motion ? motion->displacement_at(t) : Vec(Vec::Zero());
}

std::vector<Stretch> stretches_of(const Pair& pair, double end_time) {
  std::vector<double> times{0, end_time};
  for (const Motion* motion : {pair.motion_a, pair.motion_b})
    if (motion)
      for (const double t : motion->knots(end_time)) times.push_back(t);
  std::sort(times.begin(), times.end());
  std::vector<Stretch> stretches;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double length = times[k] - times[k - 1];
    if (!(length > 0)) continue;
    const Vec r = displacement(pair.motion_a, times[k - 1]) - displacement(pair.motion_b, times[k - 1]);
    const auto against = [&](double t) -> Vec {
      return velocity(pair.motion_a, t) - velocity(pair.motion_b, t);
    };
    const Vec v = against(times[k - 1]), v_end = against(times[k] - before_jump * length);
    stretches.push_back({times[k - 1], length, r, v, (v_end - v) / length});
  }
  return stretches;
}

/// Adds the times from 0 to `length` [s] at which a coordinate r + v s + a s^2/2 is c.
void add_roots(std::vector<double>& times, double length, double r, double v, double a, double c) {
  const double rest = r - c, discriminant = v * v - 2 * a * rest;
  const double q = -(v + std::copysign(std::sqrt(discriminant), v));  // without cancellation
  for (const double s : {q / a, 2 * rest / q})
    if (s > 0 && s < length) times.push_back(s);
}

/// Where the boxes of two bodies overlap while the one is displaced by what lies in `open` [m].
class Approach {
 public:
  Approach(const Pair& pair, double tolerance)
      : pair_(pair), tolerance_(tolerance), a_(bounds_of(pair.a)), b_(bounds_of(pair.b)) {
    const Part both = joined(pair.a, pair.b, Vec::Zero(), Vec::Zero());
    parts_ = !is_of_rectangles(both) || !both.without.empty() ? round_parts : 1;
  }

  std::optional<Meeting> during(const Stretch& stretch, const Vec& shift) const {
    const Box open{b_.min + shift - a_.max + Vec::Constant(tolerance_),
                   b_.max + shift - a_.min - Vec::Constant(tolerance_)};
    std::vector<double> times{0, stretch.length};
    for (int axis = 0; axis < dim; ++axis)
      for (const double edge : {open.min[axis], open.max[axis]})
        add_roots(times, stretch.length, stretch.r[axis], stretch.v[axis], stretch.a[axis], edge);
    std::sort(times.begin(), times.end());
    for (std::size_t k = 1; k < times.size(); ++k)
      if (times[k] > times[k - 1] && open.contains(stretch.at(0.5 * (times[k - 1] + times[k]))))
        if (auto meeting = between(stretch, times[k - 1], times[k], shift)) return meeting;
    return {};
  }

  /// Of all shifts by whole periods.
  std::optional<Meeting> earliest_during(const Stretch& stretch, const Vec& period) const {
    std::optional<Meeting> earliest;
    for (const Vec& shift : shifts(stretch, period))
      if (const auto meeting = during(stretch, shift);
          meeting && (!earliest || meeting->time < earliest->time))
        earliest = meeting;
    return earliest;
  }

  /// The shifts by whole periods at which the two may meet in a stretch.
  std::vector<Vec> shifts(const Stretch& stretch, const Vec& period) const {
    std::vector<Vec> found{Vec::Zero()};
    for (int axis = 0; axis < dim; ++axis) {
      if (period[axis] == 0) continue;
      double turn = stretch.a[axis] == 0 ? 0 : -stretch.v[axis] / stretch.a[axis];
      turn = std::clamp(turn, 0.0, stretch.length);
      const auto [least, most] =
          std::minmax({stretch.r[axis], stretch.at(turn)[axis], stretch.at(stretch.length)[axis]});
      const double first = std::ceil((least + a_.min[axis] - b_.max[axis]) / period[axis]);
      const double last = std::floor((most + a_.max[axis] - b_.min[axis]) / period[axis]);
      std::vector<Vec> shifted;
      // after some periods all meetings are repeats
      for (int n = 0; n < most_periods && first + n <= last; ++n)
        for (Vec shift : found) {
          shift[axis] += (first + n) * period[axis];
          shifted.push_back(shift);
        }
      found = shifted;
    }
    return found;
  }

 private:
  static constexpr int most_periods = 1000;

  std::optional<Meeting> between(const Stretch& stretch, double begin, double end, const Vec& shift) const {
    for (int k = 0; k < parts_; ++k) {
      const double s = begin + (k + 0.5) * (end - begin) / parts_, first = parts_ == 1 ? begin : s;
      const auto place = place_at(stretch, s, shift, tolerance_);
      // where they meet: boxes share just the tolerance then
      if (place)
        return Meeting{stretch.begin + first,
                       place_at(stretch, first, shift, 0.5 * tolerance_).value_or(*place)};
    }
    return {};
  }

  std::optional<Vec> place_at(const Stretch& stretch, double s, const Vec& shift, double tolerance) const {
    const Vec b_by = displacement(pair_.motion_b, stretch.begin + s);
    return place_in(joined(pair_.a, pair_.b, b_by + stretch.at(s) - shift, b_by), tolerance);
  }

  const Pair& pair_;
  double tolerance_;
  Box a_, b_;
  int parts_;
};

}  // namespace

std::optional<Meeting> first_meeting(const Pair& pair, double tolerance, double end_time, const Vec& period) {
  const Approach approach(pair, tolerance);
  const Stretch start{0, 0, Vec::Zero(), Vec::Zero(), Vec::Zero()};
  for (const Vec& shift : approach.shifts(start, period))
    if (const auto place = place_in(joined(pair.a, pair.b, -shift, Vec::Zero()), tolerance))
      return Meeting{0, *place};
  if (!pair.motion_a && !pair.motion_b) return {};
  if (pair.motion_a && pair.motion_b && *pair.motion_a == *pair.motion_b) return {};
  if (const auto turns = [](const Motion* m) { return m && m->turns(); };
      turns(pair.motion_a) || turns(pair.motion_b))
    return can_turn_with(pair) ? first_turning_meeting(pair, tolerance, end_time) : std::nullopt;
  for (const Stretch& stretch : stretches_of(pair, end_time))
    if (auto meeting = approach.earliest_during(stretch, period)) return meeting;
  return {};
}

}  // namespace toryu
