/// Guards: what lies beyond an edge of stability that a map has found is said when a case is read, with the
/// name of the map.
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
/// particles are not enough: the poles of a round body are single ones.
std::optional<std::string> beyond_thinnest(const Boundary& body, double spacing,
                                           const Parameters& parameters);

/// A sentence for each edge that a fluid lies beyond whose largest speed at the start is `speed` [m/s].
std::vector<std::string> beyond_edges(const Parameters& parameters, double speed);

}  // namespace toryu::fluid
