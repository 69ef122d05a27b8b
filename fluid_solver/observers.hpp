/// Numbers that a case asks for over time: `[[fluid.observer]]`.
#pragma once

#include "common/run/solver.hpp"
#include "common/scene/period.hpp"
#include "common/sph/kernel.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/particles.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

/// Largest x of the fluid [m]: half a spacing beyond its foremost particle.
double front_x(const Particles& fluid, double spacing);

/// Kernel mean of the equation of state's pressure about `point` [Pa]; 0 where no fluid is in reach.
double pressure_at(const Vec& point, const Particles& fluid, const Kernel& kernel,
                   const EquationOfState& state, const Period& period);

/// Flow along `axis` through `box`, which is to be full of fluid [m2/s, that is m3/s per metre depth]: the
/// box's cross-section times the mean velocity in it. A particle counts as the square of its volume, with the
/// share of it that lies in the box, so that nothing jumps when one passes the box's ends. 0 if the box is
/// empty. About an axis along it, through a ring of that cross-section [m3/s].
double flow_rate(const Particles& fluid, const Box& box, Axis axis, Geometry geometry = Geometry::plane);

/// The same of a passage whose walls stand somewhere in `box`: the sum of volume times velocity in it, over
/// its length along `axis` [m2/s]. What a passage has in the mean over that length.
double volume_flux(const Particles& fluid, const Box& box, Axis axis, Geometry geometry = Geometry::plane);

/// sum m v . v_0(x)/sum m v_0(x)^2: the velocity's share of the flow v_0 that it started with.
double flow_amplitude(const Particles& fluid, const InitialFlow& flow);

/// Root mean square of v less `share` of the initial flow at the same place, over its speed.
double flow_error(const Particles& fluid, const InitialFlow& flow, double share);

/// Farthest that a point of `box` lies from any particle, of fluid or walls, in spacings: 0.71 in a square
/// lattice, more than 1 where the medium has torn. Points are looked at in steps of a tenth of a spacing, and
/// no farther than 2 spacings.
double largest_void(const Particles& fluid, const std::vector<Boundary>& walls, const Box& box,
                    double spacing, const Period& period);

/// What observers look at.
struct Observed {
  const Particles& fluid;
  const std::vector<Boundary>& walls;
  const Parameters& parameters;
  const Kernel& kernel;
  const EquationOfState& state;
  const Period& period;
  double time;      ///< [s]
  double p_offset;  ///< what is added to the pressure of the equation of state [Pa]
  Geometry geometry = Geometry::plane;
};
Observation observe(const Observer& observer, const Observed& now);

}  // namespace toryu::fluid
