/// Bonds are the pairs of particles that are adjacent in the unloaded body. Their stretch, present over first
/// length, tells whether the body has torn or its particles have clumped. The updated Lagrangian form can do
/// both by itself, by its tensile instability, while no value of any particle leaves physics: so it always
/// watches its bonds, and says in the log and in the summary what it sees. [solid.bonds] adds columns to
/// solid.csv, and can make it end the run (`stop`). They are checked every 50 steps. The bonds also tell
/// when the body has turned or been sheared so far that the form's stress is wrong without a sign of it, and
/// when its particles have left their arrangement.
///
/// The two are told apart by the deformation of each neighbourhood, fitted to its bonds (Falk & Langer 1998),
///
///     F_i = [sum_j x_ij (x) X_ij] [sum_j X_ij (x) X_ij]^-1
///
/// The turn is the rotation of F, mean of a particle and those adjacent to it; what is left of a bond,
/// |x_ij - (F_i + F_j)/2 X_ij| over |X_ij|, is no deformation of the body: the particles have rearranged.
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
  double turn = 0;        ///< largest rotation of a neighbourhood [rad], up to pi
  double rearranged = 0;  ///< largest share of a bond that is no deformation of its neighbourhood
  long torn = 0, clumped = 0;
  std::uint32_t longest = 0, shortest = 0;  ///< a particle of the bond that is stretched most and least
  std::uint32_t displaced = 0;              ///< of the one that is rearranged most
  double strain() const { return std::max(largest - 1.0, 1.0 - smallest); }
};
template <class Archive>
void serialize(Archive& archive, Stretches& stretches) {
  auto& [largest, smallest, turn, rearranged, torn, clumped, longest, shortest, displaced] = stretches;
  archive(largest, smallest, turn, rearranged, torn, clumped, longest, shortest, displaced);
}

/// What the bonds of an updated Lagrangian solid may do before its stress is wrong; infinite where it never
/// is.
struct StressEdges {
  double turn = std::numeric_limits<double>::infinity();        ///< [rad]
  double strain = std::numeric_limits<double>::infinity();      ///< change of length over the first
  double rearranged = std::numeric_limits<double>::infinity();  ///< share of a bond
};

class Bonds {
 public:
  Bonds(const Body& body, const BondLimits& limits);
  /// At positions x [m], by number of the particle.
  Stretches stretches(const std::vector<Vec>& x) const;

 private:
  struct Bond {
    std::uint32_t i, j;
    Vec shift;      ///< of j: a period, where the body repeats itself, else zero [m]
    Vec first;      ///< from i to j in the unloaded body [m]
    double length;  ///< of `first` [m]
    Vec now(const std::vector<Vec>& x) const { return x[j] + shift - x[i]; }
  };
  /// F of each particle, of one without bonds in two directions the unit matrix.
  std::vector<Mat> deformations(const std::vector<Vec>& x) const;
  double largest_turn(const std::vector<Mat>& F) const;

  std::vector<Bond> bonds_;
  std::vector<Mat> inverse_moment_;  ///< of sum_j X_ij (x) X_ij, by particle, or zero [1/m2]
  BondLimits limits_;
};

/// Checks the bonds now and then, and warns in the log when some are torn or clumped, again whenever their
/// number has doubled, and when they are beyond the edges of the stress.
class BondWatch {
 public:
  struct State {
    Stretches worst;  ///< most bonds torn, most clumped, the largest turn [rad] and strain at any check
    long warned_torn = 0, warned_clumped = 0;  ///< of so many
  };

  BondWatch(const Body& body, const BondLimits& limits, const StressEdges& edges)
      : bonds_(body, limits), limits_(limits), edges_(edges) {}

  /// At positions x [m] at `time` [s]. Throws PhysicsFailure where the limits say so.
  void check(State& state, const std::vector<Vec>& x, double time) const;
  Stretches stretches(const std::vector<Vec>& x) const { return bonds_.stretches(x); }

 private:
  void warn_of_stress(const State& state, const Stretches& found, double time) const;
  void warn_of_rearrangement(const State& state, const Stretches& found, const Vec& place, double time) const;

  Bonds bonds_;
  BondLimits limits_;
  StressEdges edges_;
};

template <class Archive>
void serialize(Archive& archive, BondWatch::State& state) {
  auto& [worst, warned_torn, warned_clumped] = state;
  archive(worst, warned_torn, warned_clumped);
}

}  // namespace toryu::solid
