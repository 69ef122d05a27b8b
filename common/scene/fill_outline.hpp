/// Fills an outline with particles that fit it: rows parallel to the outline, the first half a spacing
/// inside, and particles of one volume in between, as even as they go.
///
/// The particles start on curves parallel to the outline, a spacing apart, and are then moved to where the
/// sum over their kernels is that of a full shape,
///
///     F_i = -sum_j V gradW_ij - sum_b W(x_i - x_b) A_b -> 0,
///
/// with A_b the pieces of the outline, outward: the integral of gradW over the shape, by Gauss's theorem. So
/// no particles are needed beyond the outline. A constant pressure then exerts no force, and F is minus the
/// gradient of what the particles' density lacks in evenness, square by square. Particles of the first row
/// move along their row alone. (After Zhu, Zhang & Hu 2021, whose level set takes the place of the integral
/// along the outline, and who start on a lattice.)
#pragma once

#include <functional>
#include <vector>

#include "common/scene/outline.hpp"

namespace toryu {

struct FittedFilling {
  std::vector<Vec> points;
  double volume = 0;  ///< of each particle: their sum is the outline's area [m2]
  int rounds = 0;     ///< that the relaxation took; 0 on a lattice
  double spread = 0;  ///< of the sums of kernels inside: their standard deviation over their mean
};

/// A rectangle whose sides are near whole numbers of spacings, turned or not, gets the lattice that it fits.
/// `told` hears how far the relaxation is, 0 to 1. Empty where the shape is too narrow for a row. The same
/// bit for bit with any number of threads.
FittedFilling fill_outline(const Outline& outline, double spacing,
                           const std::function<void(double)>& told = {});

/// Points at equal distances on curves parallel to the outline, at depths of spacing (k + 1/2), row by row,
/// and a point wherever another has room.
std::vector<Vec> parallel_rows(const Outline& outline, double spacing);

/// A piece of an outline.
struct SurfacePiece {
  Vec place;  ///< its middle [m]
  Vec area;   ///< outward [m per metre depth]
};
/// The outline in straight pieces that are no longer than `longest` [m].
std::vector<SurfacePiece> surface_pieces(const Outline& outline, double longest);

/// What of the pieces belongs to each point: a piece to the nearest one within `reach` [m] [m per metre
/// depth].
std::vector<Vec> area_vectors(const std::vector<Vec>& points, const std::vector<SurfacePiece>& pieces,
                              double reach);

}  // namespace toryu
