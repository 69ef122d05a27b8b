/// How a rigid boundary moves.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu::fluid {

struct Kinematics {
  Vec x, v, a;
};

/// It stands still.
struct Still {};
template <class Archive>
void serialize(Archive&, Still&) {}

/// It moves as its [[wall]] says.
struct PrescribedMotion {
  Motion motion;
  std::vector<Vec> start;  ///< where its particles began, moved along by periods of space [m]
  /// Over which the acceleration is averaged: sound needs as long to cross the kernel, and the fluid cannot
  /// answer a jump of the velocity sooner. Where the steps of the run fall must not matter [s].
  double response_time = 0;

  /// Gives what particle k does at `time` [s].
  auto at(double time) const {
    return [this, pose = motion.pose_at(time), turns = motion.turns(),
            a = motion.mean_acceleration(time, response_time),
            alpha = motion.mean_angular_acceleration(time, response_time)](std::uint32_t k) {
      if (!turns) return Kinematics{start[k] + pose.centre, pose.velocity, a};
      const Vec r = pose.turned(start[k] - pose.about), across = Pose::across(r);
      const double omega = pose.angular_velocity;
      return Kinematics{pose.centre + r, pose.velocity + omega * across,
                        a + alpha * across - omega * omega * r};
    };
  }
};
template <class Archive>
void serialize(Archive& archive, PrescribedMotion& prescribed) {
  auto& [motion, start, response_time] = prescribed;  // all but where it is, is the case's
  archive(start);
}

/// It is a piston that its press and the fluid push along an axis.
struct PressedMotion {
  Press press;
  std::vector<Vec> start;  ///< where its particles began [m]
  double area = 0;         ///< of its face [m per metre depth]
  double mass = 0;         ///< [kg per metre depth]
  // since the last push
  double time = 0, way = 0, speed = 0;  ///< [s], along the press's axis [m], [m/s]
  double acceleration = 0;              ///< in that push [m/s2]
  double mean_speed = 0;                ///< by which the work in that push counts [m/s]
  bool at_stop = false;                 ///< whether it has been told of that a stop holds it
  bool pushed_on = false;               ///< against a stop, in that push

  double way_at(double t) const;
  double speed_at(double t) const;  ///< 0 where a stop holds it
  /// From when on its press does not change [s].
  double steady_from() const { return (press.force.empty() ? press.pressure : press.force).back()[0]; }
  /// Gives what particle k does at `t` [s], with the acceleration of the last push: without it the pressure
  /// that the wall takes from the fluid would lag, and a piston on water would swing ever farther.
  auto at(double t) const {
    return [this, axis = press.axis(), way = way_at(t), speed = speed_at(t)](std::uint32_t k) {
      return Kinematics{start[k] + way * axis, speed * axis, acceleration * axis};
    };
  }
  /// The press, on the area `met` [m per metre depth] over which the fluid meets it, and the fluid's
  /// `reaction` [N per metre depth] act for `dt` [s] at `t`, the middle of a step. `held` is what of the
  /// pressure the fluid does not know of [Pa].
  void push(double t, double dt, const Vec& reaction, double held, double met);
  /// An implicit step (implicit/pistons.hpp) comes to its middle [s] at the speed of before, and to its end
  /// at the one that it finds, after `dt` in all [s].
  void begin_step(double middle, double end);
  void end_step(double dt, double found);
};
template <class Archive>
void serialize(Archive& archive, PressedMotion& pressed) {
  auto& [press, start, area, mass, time, way, speed, acceleration, mean_speed, at_stop, pushed_on] =
      pressed;  // the first ones are the case's
  archive(time, way, speed, acceleration, mean_speed, at_stop, pushed_on);
}

}  // namespace toryu::fluid
