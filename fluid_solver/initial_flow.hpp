/// The flows that a fluid can start with, and the pressure that belongs to each where nothing is compressed.
/// X = x - centre, k = 2 pi/length, U = speed:
///
///     taylor_green   u = -U cos(k X) sin(k Y), v = U sin(k X) cos(k Y), decays as exp(-2 nu k^2 t);
///                    p = -rho U^2/4 (cos(2 k X) + cos(2 k Y))                      (Taylor & Green 1937)
///     rotation       u = w Y, v = -w X, w = U/length; p in a square, by a series    (Le Touze et al. 2013)
///     strain         u = A X, v = -A Y, A = U/length; p in a drop that a central force holds,
///                    rho/2 (Omega^2 + A^2)(R^2 - r^2)                         (Monaghan & Rafiee 2013)
///     standing_wave  u = -U cosh(k (Y + H))/sinh(k H) sin(k X), v = U sinh(k (Y + H))/sinh(k H) cos(k X)
///                    as a flat surface passes at Y = 0 over a floor at Y = -H           (Airy 1845)
#pragma once

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

/// [m/s] at x [m].
Vec velocity(const InitialFlow& flow, const Vec& x);

/// Pressure over density [m2/s2] at x, beside that of gravity. `body` is the box of the fluid, `central_rate`
/// the Omega of the force that holds a drop [1/s].
double pressure_over_density(const InitialFlow& flow, const Box& body, double central_rate, const Vec& x);

/// exp(-2 nu k^2 t), the share of a Taylor-Green flow that is left at `time` [s]; `nu` [m2/s].
double decay(const InitialFlow& flow, double nu, double time);

}  // namespace toryu::fluid
