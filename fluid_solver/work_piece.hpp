/// The surface of a work piece: where the fluid's abrasive can touch it, told by the open faces of its
/// particles' cells.
#pragma once

#include <vector>

#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

/// Open faces of a body whose particles lie on a square lattice of `spacing` [m], and which repeats itself by
/// `shifts` (Period); about an axis the body goes on beyond it.
std::vector<Faces> lattice_faces(const std::vector<Vec>& points, double spacing,
                                 const std::vector<Vec>& shifts, Geometry geometry = Geometry::plane);

/// The same of the particles of a wall: where it is an outline, each piece of that belongs to the nearest.
std::vector<Faces> faces_of(const Wall& wall, const std::vector<Vec>& points, double spacing,
                            const std::vector<Vec>& shifts, Geometry geometry = Geometry::plane);

/// Where a work piece stands on a wall no fluid comes: closes the faces of its cells, `spacing` [m] wide,
/// that border on a cell of those `boundaries`, `wall_spacing` [m] wide, that stand still as it does or move
/// as it does, be it across a period. A solid's interface counts as still: what borders on a wall is held.
void cover_faces(Boundary& work_piece, double spacing, const std::vector<Boundary>& boundaries,
                 double wall_spacing, const std::vector<Vec>& shifts = {Vec::Zero()});

/// A place where a particle of a work piece is touched.
struct SurfacePoint {
  Vec area_vector;    ///< of its faces: length times outward normal [m]
  Vec shift;          ///< of the place from the particle [m]
  bool alone = true;  ///< whether the particle has no other
};

/// The surface of a particle with these faces: none inside; one point if all its faces look one way, along an
/// edge or across a corner. Where two opposite faces are open, as in a body that is one row thick, each side
/// has a point of its own, on the face.
std::vector<SurfacePoint> surface_points(const Faces& faces);

/// About an axis: of a point of the particle at `x` with these faces, the area of its ring over its length in
/// the plane [m].
double circumference_of(const SurfacePoint& point, const Faces& faces, const Vec& x);

}  // namespace toryu::fluid
