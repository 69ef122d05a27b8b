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
    return [this, shift = motion.displacement_at(time), v = motion.velocity_at(time),
            a = motion.mean_acceleration(time, response_time)](std::uint32_t k) {
      return Kinematics{start[k] + shift, v, a};
    };
  }
};
template <class Archive>
void serialize(Archive& archive, PrescribedMotion& prescribed) {
  auto& [motion, start, response_time] = prescribed;  // all but where it is, is the case's
  archive(start);
}

}  // namespace toryu::fluid
