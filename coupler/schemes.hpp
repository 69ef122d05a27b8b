/// The coupling schemes: in which order both sides compute a window, and what each of them knows then.
///
///     serial_robin        fluid over n with the motion predicted; solid over n under the load of n, which
///                         answers its motion by the fluid's impedance
///     serial_explicit     fluid over n with the motion extrapolated; solid over n under the load of n
///     parallel_explicit   at once: fluid over n with the motion extrapolated, solid under the load of n-1
///     serial_implicit     as serial_explicit, and again with the solid's answer, relaxed, until it settles
///
/// In each the impulse that the fluid gives is the impulse that the solid takes, in the parallel scheme one
/// window later.
#pragma once

#include <iosfwd>
#include <memory>

#include "common/link/coupling_port.hpp"
#include "coupler/parameters.hpp"

namespace toryu::coupling {

/// What a window brought.
struct Exchange {
  FluidAnswer fluid;
  std::vector<double> interface_start;     ///< where that began, if not where the window before left it [m]
  std::vector<double> interface_position;  ///< to which the fluid brought its copy of the interface [m]
  std::vector<double> returned;            ///< the impulse that the fluid gave at the start [N s/m]
  InterfaceLoad sent;                      ///< what of the fluid's load the case passes on to the solid
  InterfaceLoad applied;                   ///< what the solid computed the window with
  SolidAnswer solid;
  double fluid_compute = 0, solid_compute = 0;  ///< over all iterations [s]
  double compute = 0;                           ///< of these, what cannot be done at once [s]
  int iterations = 1;
  double residual = 0;  ///< of the last iteration, over the interface's displacement
  bool converged = true;
};

class Scheme {
 public:
  virtual ~Scheme() = default;
  /// Computes a window; `window` gets the iteration that counts.
  virtual Exchange compute(Window& window) = 0;
  /// What the next window depends on, to a checkpoint and back.
  virtual void write_state(std::ostream& stream) const = 0;
  virtual void read_state(std::istream& stream) = 0;
};

std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, CouplingPort& port,
                                    const CouplingStart& start);

}  // namespace toryu::coupling
