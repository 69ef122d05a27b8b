/// Particles that have come off: those that no chain of bonds joins to a clamp. Two particles are bonded
/// while they are nearer than the bond length, by default the support of the kernel, beyond which no force
/// reaches. Searched breadth first from the clamped particles, in the present configuration and alike in both
/// formulations (but the total Lagrangian form keeps its forces however far particles are). An early sign is
/// the largest stretch of a bond (bonds.hpp).
#pragma once

#include <functional>
#include <vector>

#include "solid_solver/body.hpp"

namespace toryu::solid {

struct DetachedParticle {
  std::uint32_t particle;
  double time;   ///< when it was first found detached [s]
  double mass;   ///< [kg/m]
  Vec start;     ///< position in the unloaded body [m]
  Vec position;  ///< when found [m]
};

class DetachmentObserver {
 public:
  /// `parameters` are those of a body that has clamps; `body` must outlive the observer.
  DetachmentObserver(const Body& body, const Parameters& parameters);

  /// Whether a look is due at `time` [s].
  bool due(double time) const { return time >= next_; }
  /// Looks for what has come off; `x` [m] holds the present positions, by number of the particle. Returns
  /// whether a particle has come off for the first time.
  bool look(const std::vector<Vec>& x, double time);

  /// 1 where the particle was detached at the last look. A particle that touches the body again is not.
  const std::vector<char>& detached() const { return detached_; }
  /// All that have come off so far, each once, in the order of time.
  const std::vector<DetachedParticle>& list() const { return list_; }

 private:
  std::vector<char> reached_from_clamps(const std::vector<Vec>& x);

  const Body* body_;
  double density_, bond_length_, interval_;
  double next_ = 0;  ///< time of the next look [s]
  std::vector<char> detached_, ever_detached_;
  std::vector<DetachedParticle> list_;
};

}  // namespace toryu::solid
