/// How a case describes motions, and what `--check` says of them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/motion.hpp"

namespace toryu {

namespace {

constexpr int knots_per_period = 16;
constexpr double most_knots = 20000;  ///< of a sine: of an endless run the beginning
constexpr int samples_per_knot = 8;
/// Of a body that spins, to its acceleration within 1 %; beyond so many turns between knots it is not
/// followed.
constexpr double samples_per_turn = 16, most_turns = 1e4;

/// A speed [1/s of the amplitude's unit] below this share of the largest is rest.
constexpr double rounding = 1e-9;

struct StartsAtOnce {
  bool operator()(const Sine& sine) const {
    return sine.ramp == 0 && std::abs(std::cos(sine.phase)) > rounding;
  }
  bool operator()(const Sway& sway) const { return (*this)(sway.sine); }
};

template <class Sines>
void require_ramps(ParameterTable& table, const Sines& sines, bool jumps) {
  table.require(
      jumps || std::none_of(sines.begin(), sines.end(), StartsAtOnce()), "sine",
      "a sine without a 'ramp' starts with its full speed at once: give it a 'ramp' [s], or say 'jumps "
      "= true' if what it moves is to start so");
}

std::vector<std::string> columns_of(const char* name, const char* unit) {
  std::vector<std::string> columns = {"time [s]"};
  for (int axis = 0; axis < dim; ++axis)
    columns.push_back(fmt::format(fmt::runtime(name), "xyz"[axis]) + unit);
  return columns;
}

constexpr const char* of_values =
    "of which the change since t = 0 counts; smooth in between, at rest at both ends";

}  // namespace

void describe(ParameterTable& table, Sway& sway) {
  describe_sine(table, sway, "m");
}

void describe(ParameterTable& table, Roll& roll) {
  describe_sine(table, roll, "rad");
}

void describe(ParameterTable& table, Turning& turning) {
  table.rows("angle", turning.angle, {"time [s]", "angle [rad]"},
             {.help = fmt::format("anticlockwise; {}", of_values)});
  require_rising(table, "angle", turning.angle, "times");
  table.rows("angular_velocity", turning.angular_velocity, {"time [s]", "angular_velocity [rad/s]"},
             {.help = "linear in between, constant before and after"});
  require_rising(table, "angular_velocity", turning.angular_velocity, "times");
  table.list("sine", turning.sine, "angles that swing");
  table.flag("jumps", turning.jumps, "whether the rate may jump: 'angle' is then linear between its rows");
  require_ramps(table, turning.sine, turning.jumps);
  table.require(!turning.angle.empty() || !turning.angular_velocity.empty() || !turning.sine.empty(), "angle",
                "what turns needs rows of its 'angle' or 'angular_velocity', or a 'sine'");
}

void describe(ParameterTable& table, Rotation& rotation) {
  table.vector("about", rotation.about,
               {.unit = "m", .required = true, .help = "the point that it turns about, as it lies at t = 0"});
  describe(table, rotation.turning);
}

void describe(ParameterTable& table, Motion& motion) {
  table.rows("velocity", motion.velocity, columns_of("v_{}", " [m/s]"),
             {.help = "linear in between, constant before and after"});
  table.number("speed", motion.speed, {.help = "multiplies the rows' velocities"});
  table.number(
      "time", motion.time,
      {.minimum = 0, .above_minimum = true, .help = "multiplies the times of the rows of 'velocity'"});
  table.rows("position", motion.position, columns_of("{}", " [m]"), {.help = of_values});
  table.list("sine", motion.sine, "shifts that swing");
  table.optional("rotation", motion.rotation, "turns about a point that goes with the rest of the motion");
  table.flag("jumps", motion.jumps,
             "whether the velocity may jump: 'position' is then linear between its rows");
  require_rising(table, "velocity", motion.velocity, "times");
  require_rising(table, "position", motion.position, "times");
  require_ramps(table, motion.sine, motion.jumps);
  table.require(
      !motion.velocity.empty() || !motion.position.empty() || !motion.sine.empty() || motion.rotation,
      "velocity", "a motion needs rows of its 'velocity' or 'position', a 'sine' or a 'rotation'");
}

void describe(ParameterTable& table, NamedMotion& named) {
  table.text("name", named.name,
             {.required = true,
              .help = "by which walls and clamps call it, and the results the walls that share it",
              .names_columns = true});
  describe(table, named.motion);
}

std::vector<double> Motion::knots(double end) const {
  std::vector<double> times{0, end};
  const auto note = [&](double t) {
    if (t > 0 && t < end) times.push_back(t);
  };
  const auto note_rows = [&](const Rows& rows, double factor, int parts) {
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (int part = 0; part < (k + 1 < rows.size() ? parts : 1); ++part)
        note(factor * (rows[k][0] + (part > 0 ? part * (rows[k + 1][0] - rows[k][0]) / parts : 0)));
  };
  const auto note_sine = [&](const Sine& s) {
    note(s.ramp);
    for (double k = 1; k < std::min(end * s.frequency * knots_per_period, most_knots); ++k)
      note(k / (s.frequency * knots_per_period));
  };
  note_rows(velocity, time, 1);
  note_rows(position, 1, knots_per_period);
  for (const Sway& sway : sine) note_sine(sway.sine);
  if (rotation) {
    note_rows(rotation->turning.angle, 1, knots_per_period);
    note_rows(rotation->turning.angular_velocity, 1, 1);
    for (const Roll& roll : rotation->turning.sine) note_sine(roll);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

MotionExtremes extremes(const Motion& motion, const std::vector<Vec>& points, double end) {
  if (!motion.rotation && points.size() > 1) return extremes(motion, {points.front()}, end);
  MotionExtremes found;
  std::vector<Vec> before;  // velocities
  double time_before = 0;
  const auto look = [&](double t) {
    const Pose pose = motion.pose_at(t);
    const Vec moved = pose.centre - pose.about;
    found.least = found.least.cwiseMin(moved), found.most = found.most.cwiseMax(moved);
    found.least_angle = std::min(found.least_angle, pose.angle);
    found.most_angle = std::max(found.most_angle, pose.angle);
    std::vector<Vec> now;
    now.reserve(points.size());
    for (const Vec& X : points) now.push_back(pose.velocity_of(X));
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (now[k].norm() > found.speed) found.speed = now[k].norm(), found.time_of_speed = t;
      if (before.empty()) continue;
      const double rate = (now[k] - before[k]).norm() / (t - time_before);
      if (rate > found.acceleration) found.acceleration = rate, found.time_of_acceleration = time_before;
    }
    before = std::move(now);
    time_before = t;
  };
  const auto knots = motion.knots(end);
  look(0);
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const double angle = std::abs(motion.pose_at(knots[k]).angle - motion.pose_at(knots[k - 1]).angle);
    const double of_turn = samples_per_turn * std::min(angle / (2 * std::numbers::pi), most_turns);
    const int samples = std::max(samples_per_knot, static_cast<int>(of_turn));
    for (int part = 1; part <= samples; ++part)
      look(part == samples ? knots[k] : knots[k - 1] + part * (knots[k] - knots[k - 1]) / samples);
  }
  return found;
}

double largest_speed(const Motion& motion, const std::vector<Vec>& points, double end) {
  if (!motion.position.empty() || !motion.sine.empty() || motion.rotation)
    return extremes(motion, points, end).speed;
  double largest = 0;
  for (const auto& row : motion.velocity) largest = std::max(largest, Vec(row[1], row[2]).norm());
  return std::abs(motion.speed) * largest;
}

std::string text_of(const MotionExtremes& found, const Motion& motion) {
  std::string text;
  for (int axis = 0; axis < dim; ++axis)
    text += fmt::format("{} {:.4g} to {:.4g} m, ", "xy"[axis], found.least[axis], found.most[axis]);
  if (motion.rotation) {
    const double degree = std::numbers::pi / 180;
    text += fmt::format("angle {:.4g} to {:.4g} rad ({:.4g} to {:.4g} degrees) about ({:.6g}, {:.6g}) m, ",
                        found.least_angle, found.most_angle, found.least_angle / degree,
                        found.most_angle / degree, motion.rotation->about[0], motion.rotation->about[1]);
  }
  return text +
         fmt::format("speed up to {:.4g} m/s at t = {:.4g} s, acceleration up to {:.4g} m/s2 at t = {:.4g} s",
                     found.speed, found.time_of_speed, found.acceleration, found.time_of_acceleration);
}

}  // namespace toryu
