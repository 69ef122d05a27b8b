/// What lies beyond an edge of stability that a map has found is warned of when a case is read, with the name
/// of the map.
#pragma once

#include <string>
#include <vector>

#include "solid_solver/bonds.hpp"
#include "solid_solver/parameters.hpp"

namespace toryu::solid {

/// Largest courant_number, times the share, that the steps of an updated Lagrangian solid bear:
///
///   symplectic  1.84, the lowest measured; omega dt = 2 of the lattice's highest mode is 1.87, with
///               omega = 1.07 c_L/h for h = 1.1 to 1.5 d_0
///   midpoint    1.1 alpha^(1/3): what artificial viscosity damps, omega alpha a share of a step,
///               outweighs the growth (omega dt)^4/8; nothing without viscosity
double courant_edge(const Parameters& parameters);

/// Beyond which motions the stress of an updated Lagrangian solid is wrong while the body looks whole:
///
///     turn    0.2 rad with plain gradients: bonds at a surface are then strained by a tenth, whatever the
///             rows (cases/rigid_rotation/turn_map.toml); renormalised ones bear any turn
///     strain  0.30, of a diagonal bond in a shear of gamma = 0.55, where G sin(gamma) of the Jaumann rate is
///             5 % short of G gamma (cases/patch_test/jaumann_map.toml)
///     rearranged  0.1 of a bond: cases/cantilever_static in this form, renormalised, 8 rows and artificial
///             stress, has 0.48, and its deflection drifts from 0.16 to 0.21 mm within a second; without
///             artificial stress 3e-4
StressEdges stress_edges(const Parameters& parameters);

/// A sentence for each edge that `parameters` lie beyond.
std::vector<std::string> stability_warnings(const Parameters& parameters);

}  // namespace toryu::solid
