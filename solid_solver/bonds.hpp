/// Bonds are the pairs of particles that are adjacent in the unloaded body. Their stretch, present over first
/// length, tells whether the body has torn or its particles have clumped. The updated Lagrangian form can do
/// both by itself, by its tensile instability, while no value of any particle leaves physics: so it always
/// watches its bonds, and says in the log and in the summary what it sees. [solid.bonds] adds columns to
/// solid.csv, and can make it end the run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "solid_solver/body.hpp"

namespace toryu {

struct Stretches {
  double largest = 1, smallest = 1;
  long torn = 0, clumped = 0;
  std::uint32_t longest = 0, shortest = 0;  ///< a particle of the bond that is stretched most and least
  double strain() const { return std::max(largest - 1.0, 1.0 - smallest); }
};

class Bonds {
 public:
  Bonds(const SolidBody& body, const BondLimits& limits);
  /// At positions x [m], by number of the particle.
  Stretches stretches(const std::vector<Vec>& x) const;

 private:
  struct Bond {
    std::uint32_t i, j;
    double length;  ///< in the unloaded body [m]
  };
  std::vector<Bond> bonds_;
  BondLimits limits_;
};

/// Looks at the bonds now and then, and warns in the log when some are torn or clumped, and again whenever
/// their number has doubled.
class BondWatch {
 public:
  BondWatch(const SolidBody& body, const BondLimits& limits) : bonds_(body, limits), limits_(limits) {}

  /// Looks at positions x [m] at `time` [s]. Throws PhysicsFailure where the limits say so.
  void look(const std::vector<Vec>& x, double time);
  Stretches stretches(const std::vector<Vec>& x) const { return bonds_.stretches(x); }
  /// Most bonds torn, and most clumped, at any look.
  std::pair<long, long> worst() const { return {most_torn_, most_clumped_}; }

 private:
  Bonds bonds_;
  BondLimits limits_;
  long most_torn_ = 0, most_clumped_ = 0, told_torn_ = 0, told_clumped_ = 0;
};

}  // namespace toryu
