/// How rigid bodies move by prescription: tables, sines and turns, which add up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/rows.hpp"
#include "common/scene/sine.hpp"

namespace toryu {

/// How far a body shifts in a sine [m], and how far it turns [rad].
struct Sway : DirectedSine {};
struct Roll : Sine {};
void describe(ParameterTable& table, Sway& sway);
void describe(ParameterTable& table, Roll& roll);

/// An angle over time [rad], anticlockwise: the sum of all that is there.
struct Turning {
  Rows angle = {};             ///< rows of time [s], angle [rad]; smooth in between, at rest at both ends
  Rows angular_velocity = {};  ///< rows of time [s], rate [rad/s]; linear in between, constant beyond
  std::vector<Roll> sine = {};
  bool jumps = false;               ///< whether the rate may jump; `angle` is linear between its rows then
  double angle_at(double t) const;  ///< since t = 0
  double rate_at(double t) const;   ///< [rad/s]
  bool operator==(const Turning&) const = default;
};
void describe(ParameterTable& table, Turning& turning);

/// A turning about a point of the body.
struct Rotation {
  Vec about = Vec::Zero();  ///< where the point is at t = 0 [m]
  Turning turning = {};
  bool operator==(const Rotation&) const = default;
};
void describe(ParameterTable& table, Rotation& rotation);

/// How a body lies and goes at one time: x = centre + R(angle) (X - about) of its point X at t = 0.
struct Pose {
  Vec about = Vec::Zero(), centre = Vec::Zero();  ///< [m]
  double angle = 0;                               ///< [rad]
  Vec velocity = Vec::Zero();                     ///< of the centre [m/s]
  double angular_velocity = 0;                    ///< [rad/s]
  /// A vector of the body, turned with it.
  Vec turned(const Vec& of_body) const { return rotation * of_body; }
  Vec place(const Vec& X) const { return centre + turned(X - about); }
  Vec velocity_of(const Vec& X) const { return velocity + angular_velocity * across(turned(X - about)); }
  /// A quarter turn anticlockwise, with which omega x r is omega across(r).
  static Vec across(const Vec& r) { return {-r[1], r[0]}; }
  Mat rotation = Mat::Identity();  ///< R(angle)
};

/// Prescribed motion of a rigid body from where the case draws it, at t = 0: the sum of all that is there. A
/// table of velocities is linear in between, constant beyond its ends; position is its integral. A cycle
/// given for unit speed serves all speeds: `speed` 2 with `time` 0.5 is twice as fast at the same stroke. A
/// table of positions is smooth: cubic, with the slope of the parabola through three rows, at rest at both
/// ends.
struct Motion {
  std::vector<std::vector<double>> velocity = {};  ///< rows of time [s], v_x, v_y [m/s]
  double speed = 1, time = 1;                      ///< multiply the velocities and the times of `velocity`
  Rows position = {};                              ///< rows of time [s], x, y [m], of which the change counts
  std::vector<Sway> sine = {};
  std::optional<Rotation> rotation = {};
  bool jumps = false;  ///< whether the velocity may jump; `position` is linear between its rows then

  bool turns() const { return rotation.has_value(); }
  Vec velocity_at(double t) const;      ///< of the centre [m/s]
  Vec displacement_at(double t) const;  ///< since t = 0 [m]; of a table of velocities the exact integral
  /// Change of the velocity over `length` [s] about t, by that length [m/s2]. The slope of a table at one
  /// instant says nothing of a jump that is over in the next.
  Vec mean_acceleration(double t, double length) const;
  double mean_angular_acceleration(double t, double length) const;  ///< likewise [rad/s2]
  Pose pose_at(double t) const;
  /// Times from 0 to `end` [s] between which it is smooth, and sines change by little.
  std::vector<double> knots(double end) const;
  bool operator==(const Motion&) const = default;
};
void describe(ParameterTable& table, Motion& motion);

/// A motion that several bodies share.
struct NamedMotion {
  std::string name;
  Motion motion = {};
};
void describe(ParameterTable& table, NamedMotion& named);

/// What a motion comes to from t = 0 to the end of a run. Of sines found at 128 times a period.
struct MotionExtremes {
  Vec least = Vec::Zero(), most = Vec::Zero();  ///< displacement of the centre [m]
  double least_angle = 0, most_angle = 0;       ///< [rad]
  double speed = 0, acceleration = 0;           ///< largest of the points [m/s], [m/s2]
  double time_of_speed = 0, time_of_acceleration = 0;
};
/// Of a body with the outermost `points` at t = 0 [m].
MotionExtremes extremes(const Motion& motion, const std::vector<Vec>& points, double end);
/// The largest of their speeds alone; where tables of velocities are all that moves it, of all rows [m/s].
double largest_speed(const Motion& motion, const std::vector<Vec>& points, double end);
/// Extremes as a sentence: "x -0.02 to 0.02 m, ...".
std::string text_of(const MotionExtremes& found, const Motion& motion);

}  // namespace toryu
