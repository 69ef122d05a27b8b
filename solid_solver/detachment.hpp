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
template <class Archive>
void serialize(Archive& archive, DetachedParticle& detached) {
  auto& [particle, time, mass, start, position] = detached;
  archive(particle, time, mass, start, position);
}

class DetachmentObserver {
 public:
  struct State {
    double next = 0;  ///< time of the next search [s]
    /// 1 where the particle was detached at the last search. A particle that touches the body again is not.
    std::vector<char> detached;
    std::vector<char> ever_detached;
    std::vector<DetachedParticle> list;  ///< all that have come off so far, each once, in the order of time
  };

  /// `parameters` are those of a body that has clamps; `body` must outlive the observer.
  DetachmentObserver(const Body& body, const Parameters& parameters);

  State start() const;
  /// Records what has come off by `time` [s]; `x` [m] holds the present positions, by number of the particle.
  /// Returns whether a particle has come off for the first time.
  bool record(State& state, const std::vector<Vec>& x, double time) const;

 private:
  std::vector<char> reached_from_clamps(const std::vector<Vec>& x) const;

  const Body* body_;
  double bond_length_, interval_;
};

template <class Archive>
void serialize(Archive& archive, DetachmentObserver::State& state) {
  auto& [next, detached, ever_detached, list] = state;
  archive(next, detached, ever_detached, list);
}

}  // namespace toryu::solid
