/// Fills bodies with particles: boxes by rows, outlines by particles that fit them (fill_outline.hpp).
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu {

/// Throws BadInput if a body of `boxes` would have more than 1e8 particles.
void check_size(const std::vector<Box>& boxes, double spacing);

/// Points of the lattice origin + (i + 1/2) spacing that lie in some of `boxes` and in none of `holes`, row
/// by row. `origin` is the smallest corner of `boxes`, so that a box whose sides are whole multiples of the
/// spacing is filled exactly, whatever the rounding. Otherwise a particle is there if its centre is inside; a
/// centre within 1e-6 spacings of an edge counts as on it, and belongs to the box whose smaller edge it is.
/// Checks the size first.
std::vector<Vec> fill(const std::vector<Box>& boxes, const std::vector<Box>& holes, double spacing);

/// Rows between two faces that stand too far from a whole number of spacings apart.
struct Misfit {
  int axis;
  double begin, end;  ///< the coordinates of the faces [m]
  long rows;  ///< that were put between them; 0: too near to each other, and the second was passed over
};

/// Particles and the sides of each one's cell [m].
struct Filling {
  std::vector<Vec> points, cells;
  bool on_lattice = true;  ///< whether they are those of `fill`
  std::vector<Misfit> misfits;
};

/// Boxes less holes.
struct Blocks {
  std::vector<Box> boxes, holes;
};

/// The same, but that rows fit between the faces of boxes and holes: where these do not lie on the lattice,
/// bodies of boxes that touch each other get rows of their own, as near to the spacing as fills the space
/// from one face to the next, so that each face has its particles half a row off and the cells have the area
/// of the boxes. Where that takes rows that are more than a tenth off, there is a misfit. Rows are in line
/// with those that `beside`, which is filled in the same way, has where it touches the body.
Filling fill_to_faces(const Blocks& body, double spacing, const Blocks& beside = {});

}  // namespace toryu
