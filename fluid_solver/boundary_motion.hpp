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

  /// Gives what particle k does at `time` [s].
  auto at(double time) const {
    return [this, shift = motion.displacement_at(time), v = motion.velocity_at(time),
            a = motion.acceleration_at(time)](std::uint32_t k) {
      return Kinematics{start[k] + shift, v, a};
    };
  }
};
template <class Archive>
void serialize(Archive& archive, PrescribedMotion& prescribed) {
  auto& [motion, start] = prescribed;  // the motion itself is the case's
  archive(start);
}

}  // namespace toryu::fluid
