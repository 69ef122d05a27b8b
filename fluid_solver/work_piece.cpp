#include "fluid_solver/work_piece.hpp"

#include <cmath>

#include "common/scene/occupancy_index.hpp"

namespace toryu::fluid {

std::vector<Vec> lattice_area_vectors(const std::vector<Vec>& points, double spacing) {
  OccupancyIndex places(0.5 * spacing);
  places.take(points, "");
  std::vector<Vec> area_vectors(points.size(), Vec::Zero());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int axis = 0; axis < dim; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const Vec face = side * spacing * Vec::Unit(axis);
        if (!places.taken(points[k] + face)) area_vectors[k] += face;
      }
  return area_vectors;
}

namespace {

/// Whether `point` lies in the cell of a particle of a wall that stands still.
bool in_a_wall(const Vec& point, const std::vector<Boundary>& boundaries, double spacing) {
  for (const auto& wall : boundaries)
    for (std::size_t k = 0; k < wall.count && !wall.moves(); ++k)
      if ((at(wall.x, k) - point).lpNorm<Eigen::Infinity>() < 0.501 * spacing) return true;
  return false;
}

}  // namespace

void cover_faces(Boundary& work_piece, double spacing, const std::vector<Boundary>& boundaries,
                 double wall_spacing) {
  // Lattices that meet need not match: a little beyond the face is far enough.
  const double distance = 0.5 * spacing + 0.25 * wall_spacing;
  for (std::size_t k = 0; k < work_piece.count; ++k)
    for (int axis = 0; axis < dim; ++axis) {
      double& area = work_piece.area_vector[axis][k];
      const Vec beyond = at(work_piece.x, k) + std::copysign(distance, area) * Vec::Unit(axis);
      if (area != 0 && in_a_wall(beyond, boundaries, wall_spacing)) area = 0;
    }
}

}  // namespace toryu::fluid
