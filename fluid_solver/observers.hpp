/// Numbers that a case asks for over time: `[[fluid.observer]]`.
#pragma once

#include "common/run/solver.hpp"
#include "common/sph/kernel.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/particles.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

/// Largest x of the fluid [m]: half a spacing beyond its foremost particle.
double front_x(const Particles& fluid, double spacing);

/// Kernel mean of the pressure about `point` [Pa]; 0 where no fluid is in reach.
double pressure_at(const Vec& point, const Particles& fluid, const CubicSpline& kernel,
                   const EquationOfState& state);

/// Flow along `axis` through `box`, which is to be full of fluid [m2/s, that is m3/s per metre depth]: the
/// box's cross-section times the mean velocity in it. A particle counts as the square of its volume, with the
/// share of it that lies in the box, so that nothing jumps when one passes the box's ends. 0 if the box is
/// empty.
double flow_rate(const Particles& fluid, const Box& box, Axis axis);

Observation observe(const Observer& observer, const Particles& fluid, double spacing,
                    const CubicSpline& kernel, const EquationOfState& state);

}  // namespace toryu::fluid
