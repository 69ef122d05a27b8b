/// What a fluid that is spread over several processes asks of the others. A process has its own particles
/// and, as ghosts in the same arrays, those of others that are near. A fluid in one process has no ranks.
#pragma once

#include "common/sph/strip_order.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

class Ranks {
 public:
  virtual ~Ranks() = default;
  /// Of the values of all processes.
  virtual double largest(double value) const = 0;
  /// Gives each process its own particles, with ghosts up to `depth` [m] around them, in the order in which
  /// the whole fluid was stored. The first time every process has all of it.
  virtual void divide(Particles& fluid, double depth) = 0;
  /// Finds the ghosts, and those of whom others have ghosts, where they are after sorting by `strips`.
  virtual void find(const Particles& fluid, const StripOrder& strips) = 0;
  /// Gives the ghosts the rates that their owners have found.
  virtual void share_rates(Particles& fluid) const = 0;
};

}  // namespace toryu::fluid
