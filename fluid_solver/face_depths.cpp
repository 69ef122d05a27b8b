#include "fluid_solver/face_depths.hpp"

#include <algorithm>
#include <cmath>

#include "common/scene/occupancy_index.hpp"
#include "common/scene/period.hpp"

namespace toryu::fluid {

namespace {

/// Of the circle through the foot of x that is as far from the tangent there as `outline` is, `step` along
/// it: the harmonic mean of both sides, which a side that is straight makes 0. 0 where they bend to different
/// sides, and at corners, which bend within the step.
double curvature_at(const Outline& outline, const Outline::Foot& foot, double step) {
  const Vec along(-foot.normal[1], foot.normal[0]);
  const auto bend = [&](double way) {
    const double off = outline.nearest(foot.place + way * along).distance;
    return 2 * off / (way * way - off * off);
  };
  const auto mean = [&](double way) {
    const double ahead = bend(way), behind = bend(-way);
    return ahead * behind > 0 ? 2 * ahead * behind / (ahead + behind) : 0.0;
  };
  const double curvature = mean(step);
  // An arc bends as much over half the step, a corner twice as much.
  const bool strong = std::abs(curvature) * step > 0.3;
  if (strong && std::abs(mean(0.5 * step)) > 1.5 * std::abs(curvature)) return 0;
  return std::abs(curvature) * step > 1 ? 0 : curvature;
}

/// Over the spacing: far enough for a bend to be seen beside the tolerance of a flattened arc.
constexpr double curvature_step = 2;

}  // namespace

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
    depths.curvature.resize(points.size(), 0.0);
    const Outline::Foot foot = outlines[k]->nearest(points[k]);
    depths.to_outline[k] = foot.place - points[k];
    depths.curvature[k] = curvature_at(*outlines[k], foot, curvature_step * spacing);
  }
  return depths;
}

}  // namespace toryu::fluid
