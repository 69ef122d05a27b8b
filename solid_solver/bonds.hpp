/// Bonds are the pairs of particles that are adjacent in the unloaded body. Their stretch, present over first
/// length, tells whether the body has torn or its particles have clumped. The updated Lagrangian form can do
/// both by itself, by its tensile instability, while no value of any particle leaves physics: so it always
/// watches its bonds, and says in the log and in the summary what it sees. [solid.bonds] adds columns to
/// solid.csv, and can make it end the run (`stop`). They are looked at every 50 steps. The bonds also tell
/// when the body has turned or been sheared so far that the form's stress is wrong without a sign of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "solid_solver/body.hpp"

namespace toryu::solid {

struct Stretches {
  double largest = 1, smallest = 1;
  double turn = 0;  ///< largest angle between a bond and its first direction [rad], up to pi
  long torn = 0, clumped = 0;
  std::uint32_t longest = 0, shortest = 0;  ///< a particle of the bond that is stretched most and least
  double strain() const { return std::max(largest - 1.0, 1.0 - smallest); }
};

/// What the bonds of an updated Lagrangian solid may do before its stress is wrong; infinite where it never
/// is.
struct StressEdges {
  double turn = std::numeric_limits<double>::infinity();    ///< [rad]
  double strain = std::numeric_limits<double>::infinity();  ///< change of length over the first
};

class Bonds {
 public:
  Bonds(const Body& body, const BondLimits& limits);
  /// At positions x [m], by number of the particle.
  Stretches stretches(const std::vector<Vec>& x) const;

 private:
  struct Bond {
    std::uint32_t i, j;
    Vec first;      ///< from i to j in the unloaded body [m]
    double length;  ///< of `first` [m]
  };
  std::vector<Bond> bonds_;
  BondLimits limits_;
};

/// Looks at the bonds now and then, and warns in the log when some are torn or clumped, again whenever their
/// number has doubled, and when they are beyond the edges of the stress.
class BondWatch {
 public:
  BondWatch(const Body& body, const BondLimits& limits, const StressEdges& edges)
      : bonds_(body, limits), limits_(limits), edges_(edges) {}

  /// Looks at positions x [m] at `time` [s]. Throws PhysicsFailure where the limits say so.
  void look(const std::vector<Vec>& x, double time);
  Stretches stretches(const std::vector<Vec>& x) const { return bonds_.stretches(x); }
  /// Most bonds torn, most clumped, the largest turn [rad] and the largest strain at any look.
  const Stretches& worst() const { return worst_; }

 private:
  void tell_of_stress(const Stretches& found, double time);

  Bonds bonds_;
  BondLimits limits_;
  StressEdges edges_;
  Stretches worst_;
  long told_torn_ = 0, told_clumped_ = 0;
};

}  // namespace toryu::solid
