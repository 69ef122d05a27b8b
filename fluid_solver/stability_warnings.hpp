/// Stability warnings: what lies beyond an edge of stability that a map has found is said when a case is
/// read, with the name of the map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

/// Largest time_step_share that the steps bear, by cases/hydrostatic_tank/time_step_map.toml:
///
///   symplectic  6.7: omega dt = 2 of the lattice's highest mode, omega = 1.07 c_0/h to 1.2 c_0/h
///   midpoint    2.6 (delta/0.1)^(1/3): what density diffusion damps outweighs the growth (omega dt)^4/8;
///               without it 0.8 for some thousand steps, for ever nothing
double time_step_edge(const Parameters& parameters);

/// Thickness of a wall [m] below which fluid on one side of it acts on fluid on the other, 2h - d0: the
/// outermost rows stand half a spacing off (cases/thin_wall/thin_wall_map.toml).
double thinnest_wall(const Parameters& parameters);

/// A sentence if the body, of particles `spacing` [m] apart, is thinner than that along x or y. A few
/// particles are not enough: the poles of a round body are single ones. Space repeats itself by `shifts`
/// (Period).
std::optional<std::string> beyond_thinnest(const Boundary& body, double spacing, const Parameters& parameters,
                                           const std::vector<Vec>& shifts = {Vec::Zero()});

/// A sentence if the fluid is narrower than 3 spacings along x or y in so many places, walls beside it
/// counted as fluid: a jet of 1 or 2 particles bounces with 11 to 46 % of its momentum, and one of 3 with 10
/// to 16 % (cases/thin_jet/near_singular_map.toml).
std::optional<std::string> beyond_thinnest_jet(const Particles& fluid, const std::vector<Boundary>& walls,
                                               double spacing,
                                               const std::vector<Vec>& shifts = {Vec::Zero()});

/// A sentence if the particles of an elastic work piece stand `spacing` [m], farther apart than the fluid's:
/// a medium that finds gaps in the surface sticks to it, and what friction and removal give is far too small.
std::optional<std::string> beyond_coarsest_work_piece(double spacing, const Parameters& parameters);

/// A sentence if the medium sticks to work pieces from which it removes: it is the grain's length then that
/// says how fast their surface is rubbed.
std::optional<std::string> removal_by_grain_length(const Parameters& parameters);

/// Speed over c_0 that a wall takes up or loses at once above which pressures are 15 % off rho c_0 v, by
/// cases/retreating_piston/start_map.toml.
inline constexpr double start_edge = 0.075;

/// Sound speed over sqrt(g H) below which water H deep still swings after 2 s, or has a wrong pressure, by
/// cases/hydrostatic_tank/start_map.toml: where it starts under its own weight, and where gravity sets in at
/// once.
inline constexpr double depth_edge_hydrostatic = 2.1, depth_edge_at_once = 6.9;

/// With [fluid.similarity], which knows the passage: a round one that draws the rings of the medium farther
/// apart than the kernel bears.
std::optional<std::string> beyond_thinnest_rings(const Parameters& parameters, const Scene& scene);

/// The velocity of a wall that changes while sound crosses the kernel: a blow, of pressure rho_0 c_0 v.
struct Blow {
  double speed = 0;  ///< across its shorter side: what slides sends no sound [m/s]
  std::string wall = {};
  double time = 0;  ///< when it is over [s]
};

/// What a fluid starts with, and what awaits it.
struct Start {
  double speed = 0;           ///< the largest of the fluid [m/s]
  Blow blow = {};             ///< the hardest by a wall
  Vec gravity = Vec::Zero();  ///< under which the fluid has a depth [m/s2]
};

/// Gravity less its part along directions in which space repeats itself: there it drives a flow, and no fluid
/// weighs on another.
Vec gravity_on_columns(const Scene& scene);

/// The hardest blow by a prescribed motion until the end of the run; at the start against the fluid's own
/// velocity.
Blow hardest_blow(const Scene& scene, const Parameters& parameters);

/// A sentence for each edge that a fluid lies beyond.
std::vector<std::string> stability_warnings(const Parameters& parameters, const Start& start);

}  // namespace toryu::fluid
