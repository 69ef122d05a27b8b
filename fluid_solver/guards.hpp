/// Guards: what lies beyond an edge of stability that a map has found is said when a case is read, with the
/// name of the map.
#pragma once

#include <string>
#include <vector>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

/// Largest time_step_share that the steps bear, by cases/hydrostatic_tank/time_step_map.toml:
///
///   symplectic  6.7: omega dt = 2 of the lattice's highest mode, omega = 1.07 c_0/h to 1.2 c_0/h
///   midpoint    2.6 (delta/0.1)^(1/3): what density diffusion damps outweighs the growth (omega dt)^4/8;
///               without it 0.8 for some thousand steps, for ever nothing
double time_step_edge(const Parameters& parameters);

/// A sentence for each edge that a fluid lies beyond whose largest speed at the start is `speed` [m/s].
std::vector<std::string> beyond_edges(const Parameters& parameters, double speed);

}  // namespace toryu::fluid
