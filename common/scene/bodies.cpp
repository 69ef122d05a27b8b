#include "common/scene/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/case_bodies.hpp"
#include "common/scene/outline.hpp"
#include "common/scene/period.hpp"
#include "common/scene/turning_meeting.hpp"

namespace toryu {

namespace {

/// Over the finest spacing: bodies that share less than this touch, and so do those that stand no farther
/// off.
constexpr double touching = 0.1;
/// Over the fluid's spacing: who stands so far off does not seem to touch.
constexpr double apart = 0.9;

double finest_spacing(const CaseFile& file) {
  double finest = 0;
  for (const char* spacing : {"fluid.spacing", "solid.spacing"})
    if (const double value = file.value<double>(spacing).value_or(0); value > 0)
      finest = finest > 0 ? std::min(finest, value) : value;
  return finest;
}

/// The fluid's face that stands off the other body, the body's, and what lies between along `axis`.
struct Gap {
  int axis;
  double face, other;  ///< [m]
  Box space;
  double width() const { return std::abs(other - face); }
};

/// Whether one side of what is held lies on the wall all along, looked at in some places.
bool is_fixed_on(const Part& held, const Box& wall, double tolerance) {
  constexpr int places = 9;
  const Box box = bounds_of(held);
  if (!box.is_sound()) return false;
  const Outline outline = outline_of(wall);
  for (int axis = 0; axis < dim; ++axis)
    for (const Vec& corner : {box.min, box.max}) {
      int on = 0;
      for (int k = 0; k < places; ++k) {
        Vec x = corner;
        x[1 - axis] = box.min[1 - axis] + (box.max - box.min)[1 - axis] * k / (places - 1);
        on += outline.nearest(x).distance <= tolerance;
      }
      if (on == places) return true;
    }
  return false;
}

std::optional<Gap> gap_between(const Box& fluid, const Box& other, double least) {
  if (!fluid.is_rectangle() || !other.is_rectangle()) return {};
  for (int axis = 0; axis < dim; ++axis) {
    const int across = 1 - axis;
    const double low = std::max(fluid.min[across], other.min[across]),
                 high = std::min(fluid.max[across], other.max[across]);
    if (high - low <= least) continue;
    const auto gap = [&](double face, double of_other) {
      Gap found{axis, face, of_other, {}};
      found.space.min[axis] = std::min(face, of_other), found.space.max[axis] = std::max(face, of_other);
      found.space.min[across] = low, found.space.max[across] = high;
      return found;
    };
    if (fluid.min[axis] - other.max[axis] > least) return gap(fluid.min[axis], other.max[axis]);
    if (other.min[axis] - fluid.max[axis] > least) return gap(fluid.max[axis], other.min[axis]);
  }
  return {};
}

std::string gap_text(const Body& region, const Body& other, const Gap& gap, double spacing) {
  return fmt::format(
      "{} ends at {} = {:.6g} m, {:.2g} spacings off {}: it does not rest on it, but moves into the gap; let "
      "it end at {:.6g} m, or a spacing or more apart",
      region.name, "xy"[gap.axis], gap.face, gap.width() / spacing, other.name, gap.other);
}

/// The medium gives way to bodies that no box could be cut out for.
bool is_left_out(const Body& body) {
  return body.part.within[0].outline != nullptr;
}

class Bodies {
 public:
  Bodies(const CaseFile& file, const Scene& scene)
      : file_(file),
        end_time_(scene.end_time),
        bodies_(file, scene),
        tolerance_(touching * finest_spacing(file)),
        domain_(scene.domain),
        period_(scene) {
    for (Held& part : bodies_.held)
      if (!part.motion) part.motion = motion_of_holder(part);
  }

  /// By clamp; none where it stands still.
  std::vector<std::optional<Motion>> clamp_motions() const {
    std::vector<std::optional<Motion>> motions(file_.count("solid.clamp"));
    for (const Held& part : bodies_.held)
      if (part.motion && !motions[part.clamp]) motions[part.clamp] = *part.motion;
    return motions;
  }

  /// Key and message of each fault.
  using Faults = std::vector<std::pair<std::string, std::string>>;
  Faults faults() const {
    Faults found;
    for (std::size_t i = 0; i < bodies_.swept.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const bool by_travel = (bodies_.swept[i].travels || bodies_.swept[k].travels) &&
                               !meeting(bodies_.walls[i], bodies_.walls[k], 0);
        keep_apart(bodies_.swept[i], bodies_.swept[k], end_time_,
                   by_travel ? ", with the travel of what is pressed" : "", found);
      }
    for (const auto* bodies : {&bodies_.swept, &bodies_.solid})
      for (const Body& body : *bodies) keep_off_itself(body, found);
    for (const auto* bodies : {&bodies_.fluid, &bodies_.solid})
      for (const Body& body : *bodies) keep_in_domain(body, found);
    for (const Body& region : bodies_.fluid)
      for (const auto* bodies : {&bodies_.walls, &bodies_.solid})
        for (const Body& other : *bodies)
          if (!is_left_out(other)) keep_apart(region, other, 0, "", found);
    const bool rigid = file_.value<std::string>("solid.formulation") == "rigid";  // which takes no clamps
    for (const Body& wall : bodies_.walls) {
      for (const Body& part : bodies_.free)
        keep_apart(wall, part, 0, rigid ? "" : "; what a wall holds of a solid is a [[solid.clamp]]", found);
      for (const Held& part : bodies_.held) keep_together(wall, part, found);
    }
    for (std::size_t i = 0; i < bodies_.held.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) keep_alike(bodies_.held[i], bodies_.held[k], found);
    return found;
  }

  std::vector<Box> left_out() const {
    std::vector<Box> boxes;
    for (const auto* bodies : {&bodies_.walls, &bodies_.solid})
      for (const Body& body : *bodies)
        if (is_left_out(body)) boxes.push_back(body.part.within[0]);
    return boxes;
  }

  std::vector<std::string> motion_lines() const {
    struct Group {
      const Motion* motion;
      std::vector<std::string> names;
      std::vector<Vec> points;
    };
    std::vector<Group> groups;
    const auto add = [&](const Body& body) {
      const Box box = bounds_of(body.part);
      if (!body.motion || !box.is_sound()) return;
      auto group = std::find_if(groups.begin(), groups.end(),
                                [&](const Group& g) { return *g.motion == *body.motion; });
      if (group == groups.end()) group = groups.insert(groups.end(), {body.motion, {}, {}});
      if (std::find(group->names.begin(), group->names.end(), body.name) == group->names.end())
        group->names.push_back(body.name);
      for (const Vec& corner : corners_of(body.part.within.size() == 1 ? body.part.within[0] : box))
        group->points.push_back(corner);
    };
    for (const Body& wall : bodies_.walls) add(wall);
    for (const Held& part : bodies_.held) add(part);
    std::vector<std::string> lines;
    lines.reserve(groups.size());
    for (const auto& [motion, names, points] : groups)
      lines.push_back(fmt::format("{} {}: {}", fmt::join(names, ", "), names.size() == 1 ? "moves" : "move",
                                  text_of(extremes(*motion, points, end_time_), *motion)));
    return lines;
  }

  /// Pairs of walls of which one turns and that are too intricate to be looked at.
  std::vector<std::string> unknown_meetings() const {
    std::vector<std::string> said;
    for (std::size_t i = 0; i < bodies_.walls.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const Body &a = bodies_.walls[i], &b = bodies_.walls[k];
        const bool turns = (a.motion && a.motion->turns()) || (b.motion && b.motion->turns());
        const Pair pair{a.part, b.part, a.motion, b.motion};
        if (!turns || (a.motion && b.motion && *a.motion == *b.motion) || can_turn_with(pair)) continue;
        if (may_meet_turning(pair, tolerance_, end_time_))
          said.push_back(
              fmt::format("{} and {}: whether they meet is not looked at, since one of them turns and "
                          "has holes or is not convex",
                          a.name, b.name));
      }
    return said;
  }

  std::vector<std::string> passages() const {
    std::vector<std::string> said;
    const auto moves = [](const Held& part) { return part.motion != nullptr; };
    if (file_.has("solid.wall_contact") || std::any_of(bodies_.held.begin(), bodies_.held.end(), moves))
      return said;
    for (const Body& wall : bodies_.walls)
      for (const Body& part : bodies_.free) {
        if (!wall.motion) continue;
        if (wall.motion->turns())
          said.push_back(
              fmt::format("{} turns: whether it comes to where {} is at the start is not looked at",
                          wall.name, part.name));
        else if (const auto found = meeting(wall, part, end_time_))
          said.push_back(
              fmt::format("{} comes to where {} is at the start at t = {:.4g} s near ({:.6g}, {:.6g}) m, and "
                          "without [solid.wall_contact] passes through it",
                          wall.name, part.name, found->time, found->place[0], found->place[1]));
      }
    return said;
  }

  std::vector<std::string> gaps() const {
    const double spacing = file_.value<double>("fluid.spacing").value_or(0);
    std::vector<std::string> said;
    for (const Body& region : bodies_.fluid)
      for (const auto* bodies : {&bodies_.walls, &bodies_.solid})
        for (const Body& other : *bodies)
          if (const auto gap = gap_between(region.part.within[0], other.part.within[0], touching * spacing))
            if (gap->width() < apart * spacing && !is_at_seam(*gap) && !is_filled(*gap))
              said.push_back(gap_text(region, other, *gap, spacing));
    return said;
  }

 private:
  /// Whether other bodies take all of it: of those that stand side by side the fluid touches the first one.
  bool is_filled(const Gap& gap) const {
    Part left{{gap.space}, {}};
    for (const auto* bodies : {&bodies_.fluid, &bodies_.walls, &bodies_.solid})
      for (const Body& body : *bodies)
        if (body.part.within.size() == 1 && body.part.without.empty())
          left.without.push_back(body.part.within[0]);
    return !place_in(left, tolerance_);
  }

  /// Whether the fluid's face is none, since space repeats itself there.
  bool is_at_seam(const Gap& gap) const {
    return period_.along(gap.axis) && std::min(std::abs(gap.face - domain_.min[gap.axis]),
                                               std::abs(gap.face - domain_.max[gap.axis])) < tolerance_;
  }

  std::optional<Meeting> meeting(const Body& a, const Body& b, double end_time) const {
    const Pair pair{a.part, b.part, end_time > 0 ? a.motion : nullptr, end_time > 0 ? b.motion : nullptr};
    auto found = first_meeting(pair, tolerance_, end_time, period_.length());
    if (found) found->place = period_.inside(found->place);
    return found;
  }

  void keep_off_itself(const Body& body, Faults& faults) const {
    const Box box = bounds_of(body.part);
    if (!box.is_sound()) return;
    for (int axis = 0; axis < dim; ++axis)
      if (period_.along(axis) && box.max[axis] - box.min[axis] > period_.length()[axis] + tolerance_)
        faults.emplace_back(
            body.key,
            fmt::format("{} is {:.6g} m long along {}, in which space repeats itself after {:.6g} m: "
                        "it overlaps itself",
                        body.name, box.max[axis] - box.min[axis], "xy"[axis], period_.length()[axis]));
  }

  void keep_apart(const Body& a, const Body& b, double end_time, const std::string& hint,
                  Faults& faults) const {
    const auto found = meeting(a, b, end_time);
    if (!found) return;
    const std::string what =
        found->time == 0 ? fmt::format("{} overlaps {}", a.name, b.name)
                         : fmt::format("{} runs into {} at t = {:.4g} s", a.name, b.name, found->time);
    faults.emplace_back(
        a.key, fmt::format("{} near ({:.6g}, {:.6g}) m{}", what, found->place[0], found->place[1], hint));
  }

  bool holds(const Body& wall, const Held& part) const {
    const auto& shifts = period_.shifts();
    return meeting(wall, part, 0) || std::any_of(shifts.begin(), shifts.end(), [&](const Vec& shift) {
             return is_fixed_on(part.part, wall.part.within[0].moved(shift), tolerance_);
           });
  }

  /// None if nothing holds it, or if anything at rest does.
  const Motion* motion_of_holder(const Held& part) const {
    const Motion* motion = nullptr;
    for (const Body& wall : bodies_.walls) {
      if (!holds(wall, part)) continue;
      if (!wall.motion || !moves(*wall.motion)) return nullptr;
      motion = wall.motion;
    }
    return motion;
  }

  /// Whether a part of it leaves the domain, its particles show.
  void keep_in_domain(const Body& body, Faults& faults) const {
    const Box box = bounds_of(body.part);
    for (int axis = 0; axis < dim && domain_.is_sound() && box.is_sound(); ++axis)
      if (!period_.along(axis) && (box.min[axis] >= domain_.max[axis] || box.max[axis] <= domain_.min[axis]))
        return void(faults.emplace_back(body.key, body.name + " lies outside [case.domain]"));
  }

  /// A wall that holds a clamp and the clamp move as one; any other must not run into it.
  void keep_together(const Body& wall, const Held& part, Faults& faults) const {
    const bool wall_moves = wall.motion && moves(*wall.motion),
               part_moves = part.motion && moves(*part.motion);
    if (!wall_moves && !part_moves) return;
    if (!holds(wall, part)) return keep_apart(wall, part, end_time_, "", faults);
    if (wall_moves && part_moves && *wall.motion == *part.motion) return;
    const std::string how = !part_moves ? "stands still" : wall_moves ? "moves otherwise" : "moves";
    faults.emplace_back(wall.key, fmt::format("{} {}, and {}, which it holds, {}", wall.name,
                                              wall_moves ? "moves" : "stands still", part.name, how));
  }

  /// What two clamps hold can follow but one of them.
  void keep_alike(const Held& a, const Held& b, Faults& faults) const {
    if (a.clamp == b.clamp) return;
    const bool a_moves = a.motion && moves(*a.motion), b_moves = b.motion && moves(*b.motion);
    if ((!a_moves && !b_moves) || (a_moves && b_moves && *a.motion == *b.motion)) return;
    if (const auto found = meeting(a, b, 0))
      faults.emplace_back(
          a.key, fmt::format("{} overlaps {} near ({:.6g}, {:.6g}) m, and they do not move alike", a.name,
                             b.name, found->place[0], found->place[1]));
  }

  bool moves(const Motion& motion) const {
    const auto times = motion.knots(end_time_);
    return motion.turns() || std::any_of(times.begin(), times.end(),
                                         [&](double t) { return !motion.velocity_at(t).isZero(0); });
  }

  const CaseFile& file_;
  double end_time_;
  CaseBodies bodies_;
  double tolerance_;
  Box domain_;
  Period period_;
};

}  // namespace

void check_bodies(CaseFile& file, const Scene& scene) {
  if (file.kind() == Kind::study) return;
  for (const auto& [key, message] : Bodies(file, scene).faults()) file.fault(key, message);
}

std::vector<Box> left_out_of_fluid(const CaseFile& file, const Scene& scene) {
  return Bodies(file, scene).left_out();
}

std::vector<std::optional<Motion>> clamp_motions(const CaseFile& file, const Scene& scene) {
  return Bodies(file, scene).clamp_motions();
}

std::vector<std::string> motion_lines(const CaseFile& file, const Scene& scene) {
  return Bodies(file, scene).motion_lines();
}

std::vector<std::string> unknown_meetings(const CaseFile& file, const Scene& scene) {
  return Bodies(file, scene).unknown_meetings();
}

std::vector<std::string> passage_warnings(const CaseFile& file, const Scene& scene) {
  return Bodies(file, scene).passages();
}

std::vector<std::string> gap_warnings(const CaseFile& file, const Scene& scene) {
  return Bodies(file, scene).gaps();
}

}  // namespace toryu
