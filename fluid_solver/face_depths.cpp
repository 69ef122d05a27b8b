#include "fluid_solver/face_depths.hpp"

#include <algorithm>

#include "common/scene/occupancy_index.hpp"
#include "common/scene/period.hpp"

namespace toryu::fluid {

FaceDepths lattice_face_depths(const std::vector<Vec>& points, double spacing, double far,
                               const std::vector<Vec>& shifts) {
  OccupancyIndex places(0.5 * spacing);
  places.take(with_images(points, shifts), "");
  const auto depth = [&](const Vec& x, const Vec& direction) {
    double steps = 1;
    while ((steps - 0.5) * spacing < far && places.taken(x + steps * spacing * direction)) ++steps;
    return std::min((steps - 0.5) * spacing, far);
  };
  FaceDepths depths{points, points};
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int a = 0; a < dim; ++a) {
      depths.up[k][a] = depth(points[k], Vec::Unit(a));
      depths.down[k][a] = depth(points[k], -Vec::Unit(a));
    }
  return depths;
}

FaceDepths face_depths(const std::vector<Vec>& points, const std::vector<const Outline*>& outlines,
                       double spacing, double far, const std::vector<Vec>& shifts) {
  FaceDepths depths = lattice_face_depths(points, spacing, far, shifts);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!outlines[k]) continue;
    depths.up[k] = depths.down[k] = Vec::Constant(far);
    depths.to_outline.resize(points.size(), Vec::Zero());
    depths.to_outline[k] = outlines[k]->nearest(points[k]).place - points[k];
  }
  return depths;
}

}  // namespace toryu::fluid
