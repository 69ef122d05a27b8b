/// The surface of a work piece: where the fluid's abrasive can touch it. An area vector [m per metre depth]
/// of a particle is the sum of its cell's open faces, each its length times the outward normal; zero inside.
#pragma once

#include <vector>

#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

/// Area vectors of a body whose particles lie on a square lattice of `spacing` [m].
std::vector<Vec> lattice_area_vectors(const std::vector<Vec>& points, double spacing);

/// Where a work piece stands on a wall no fluid comes: takes off the faces of its cells, `spacing` [m] wide,
/// that border on a cell of those `boundaries` that stand still, `wall_spacing` [m] wide.
void cover_faces(Boundary& work_piece, double spacing, const std::vector<Boundary>& boundaries,
                 double wall_spacing);

}  // namespace toryu::fluid
