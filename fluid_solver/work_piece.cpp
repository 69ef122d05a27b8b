#include "fluid_solver/work_piece.hpp"

#include <algorithm>
#include <cmath>

#include "common/scene/fill_outline.hpp"
#include "common/scene/occupancy_index.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"

namespace toryu::fluid {

std::vector<Faces> lattice_faces(const std::vector<Vec>& points, double spacing,
                                 const std::vector<Vec>& shifts, Geometry geometry) {
  OccupancyIndex places(0.5 * spacing);
  for (const Vec& shift : shifts) {
    std::vector<Vec> image = points;
    for (Vec& x : image) x += shift;
    places.take(image, "");
    if (geometry == Geometry::plane) continue;
    for (Vec& x : image) x[1] = -x[1];
    places.take(image, "");
  }
  std::vector<Faces> faces(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int axis = 0; axis < dim; ++axis) {
      const Vec next = spacing * Vec::Unit(axis);
      if (!places.taken(points[k] - next)) faces[k].lower[axis] = spacing;
      if (!places.taken(points[k] + next)) faces[k].upper[axis] = spacing;
    }
  return faces;
}

namespace {

/// Over the spacing: pieces of an outline, how far beyond one the wall may go on, and how far the particle of
/// a piece may be, in a sharp corner.
constexpr double longest_piece = 1.0 / 8, beside = 0.01, furthest_particle = 4;

/// The faces of points that fit an outline, as it is.
std::vector<Faces> outline_faces(const Outline& outline, const std::vector<Vec>& points, double spacing,
                                 const std::vector<Vec>& shifts, Geometry geometry) {
  auto pieces = surface_pieces(outline, longest_piece * spacing);
  std::erase_if(pieces, [&](const SurfacePiece& piece) {
    if (geometry == Geometry::axisymmetric && piece.place[1] < beside * spacing) return true;  // on the axis
    const Vec beyond = piece.place + beside * spacing * piece.area.normalized();
    return std::any_of(shifts.begin(), shifts.end(),
                       [&](const Vec& shift) { return outline.contains(beyond - shift); });
  });
  std::vector<Faces> faces;
  for (const Vec& area : area_vectors(points, pieces, furthest_particle * spacing))
    faces.push_back(faces_of(area));
  return faces;
}

}  // namespace

std::vector<Faces> faces_of(const Wall& wall, const std::vector<Vec>& points, double spacing,
                            const std::vector<Vec>& shifts, Geometry geometry) {
  return wall.box.outline ? outline_faces(*wall.box.outline, points, spacing, shifts, geometry)
                          : lattice_faces(points, spacing, shifts, geometry);
}

namespace {

bool same_motion(const Boundary& work_piece, const Boundary& wall) {
  if (!wall.moves()) return !work_piece.moves() || work_piece.is_interface();
  const auto* one = std::get_if<PrescribedMotion>(&work_piece.motion);
  const auto* other = std::get_if<PrescribedMotion>(&wall.motion);
  return one && other && one->motion == other->motion;
}

}  // namespace

void cover_faces(Boundary& work_piece, double spacing, const std::vector<Boundary>& boundaries,
                 double wall_spacing, const std::vector<Vec>& shifts) {
  // Lattices that meet need not match: a little beyond the face is far enough.
  const double distance = 0.5 * spacing + 0.25 * wall_spacing;
  for (const Boundary& wall : boundaries) {
    if (&wall == &work_piece || !same_motion(work_piece, wall)) continue;
    for (std::size_t k = 0; k < work_piece.count; ++k)
      for (int axis = 0; axis < dim; ++axis)
        for (const double side : {-1.0, 1.0}) {
          double& face = (side < 0 ? work_piece.lower_face : work_piece.upper_face)[axis][k];
          const Vec before = at(work_piece.x, k) + side * distance * Vec::Unit(axis);
          if (face != 0 && wall.covers(before, wall_spacing, shifts)) face = 0;
        }
  }
}

std::vector<SurfacePoint> surface_points(const Faces& faces) {
  const Vec sum = faces.upper - faces.lower;
  const auto opposite = (faces.lower.array() > 0 && faces.upper.array() > 0).eval();
  if (!opposite.any()) {
    if (sum.isZero(0)) return {};
    return {{.area_vector = sum, .shift = Vec::Zero()}};
  }
  // A point for each choice of sides. Each face is shared by those that have it.
  const double points = std::exp2(opposite.count());
  std::vector<SurfacePoint> result{{.area_vector = sum / points, .shift = Vec::Zero(), .alone = false}};
  for (int axis = 0; axis < dim; ++axis) {
    if (!opposite[axis]) continue;
    std::vector<SurfacePoint> sides;
    for (const double side : {-1.0, 1.0})
      for (SurfacePoint point : result) {
        const double face = side < 0 ? faces.lower[axis] : faces.upper[axis];
        point.area_vector[axis] = side * face * 2 / points;
        point.shift[axis] = 0.5 * side * face;
        sides.push_back(point);
      }
    result = sides;
  }
  return result;
}

double circumference_of(const SurfacePoint& point, const Faces& faces, const Vec& x) {
  const Vec half = 0.5 * faces.lower.cwiseMax(faces.upper);
  const Vec& A = point.area_vector;
  const Vec ring(A[0] * circumference(x[1]), A[1] * circumference(x[1] + std::copysign(half[1], A[1])));
  return ring.norm() / A.norm();
}

}  // namespace toryu::fluid
