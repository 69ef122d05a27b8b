/// The solid as a run and its partners see it: of one formulation (SolidModel), or elastic and rigid bodies
/// beside each other (MixedSolid).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/link/participant.hpp"
#include "common/run/solver.hpp"
#include "common/run/timers.hpp"
#include "solid_solver/detachment.hpp"

namespace toryu::solid {

/// Takes all particles that have come off so far, whenever there are new ones.
using RecordDetached = std::function<void(const std::vector<DetachedParticle>&)>;

class Solid : public Solver {
 public:
  /// The particles that a fluid which sees `reach` [m] deep can touch, unloaded.
  virtual Interface interface(double reach) const = 0;
  virtual InterfaceMotion motion(const std::vector<std::uint32_t>& particles) const = 0;
  /// Sets the force on the interface [N per metre depth], which holds until the next call. Returns the sum
  /// that the solid takes per second, clamps included [N per metre depth].
  virtual Vec set_interface_load(const std::vector<std::uint32_t>& particles, const InterfaceLoad& load) = 0;
  /// What the interface has taken since then beyond that force, by the load's impedance: dim values a
  /// particle [N s per metre depth]; empty if the load has none.
  virtual std::vector<double> excess_impulse() const = 0;
  virtual double work_of_excess_impulse() const = 0;  ///< [J per metre depth]
  virtual Health health() const = 0;
  /// From now on `record` gets the particles that come off, once that is final. Needs [solid.detachment].
  virtual void record_detached(const RecordDetached& record) = 0;
  virtual const Timers& timers() const = 0;
};

}  // namespace toryu::solid
