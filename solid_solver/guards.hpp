/// Guards: what lies beyond an edge of stability that a map has found is said when a case is read, with the
/// name of the map.
#pragma once

#include <string>
#include <vector>

#include "solid_solver/parameters.hpp"

namespace toryu {

/// Largest courant_number, times the share, that the steps of an updated Lagrangian solid bear:
///
///   symplectic  1.84, the lowest measured; omega dt = 2 of the lattice's highest mode is 1.87, with
///               omega = 1.07 c_L/h for h = 1.1 to 1.5 d_0
///   midpoint    1.1 alpha^(1/3): what artificial viscosity damps, omega alpha a share of a step,
///               outweighs the growth (omega dt)^4/8; nothing without viscosity
double courant_edge(const SolidParameters& parameters);

/// A sentence for each edge that `parameters` lie beyond.
std::vector<std::string> beyond_edges(const SolidParameters& parameters);

}  // namespace toryu
