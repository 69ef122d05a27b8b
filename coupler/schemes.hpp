/// The coupling schemes: in which order both sides compute a window, and what each of them knows then.
///
///     serial_explicit     fluid over n with the motion forecast; solid over n under the load of n
///     parallel_explicit   at once: fluid over n with the motion forecast, solid over n under the load of n-1
///     serial_implicit     as serial_explicit, and again with the solid's answer, relaxed, until it settles
///
/// In each the impulse that the fluid gives is the impulse that the solid takes, in the parallel scheme one
/// window later.
#pragma once

#include <memory>

#include "common/link/coupler_link.hpp"
#include "coupler/parameters.hpp"

namespace toryu::coupling {

/// What a window brought.
struct Exchange {
  CouplerLink::FluidAnswer fluid;
  std::vector<double> followed;  ///< positions to which the fluid brought its copy of the interface [m]
  InterfaceLoad given;           ///< what of the fluid's load the case lets the solid feel
  InterfaceLoad felt;            ///< what the solid computed the window with
  CouplerLink::SolidAnswer solid;
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
};

std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, CouplerLink& link,
                                    const CouplerLink::Start& start);

}  // namespace toryu::coupling
