/// Walls whose faces have worn away (common/scene/worn_face.hpp): where their particles stand, and how the
/// fluid fills the space before them.
///
/// The particles of a wall go along with its face, column by column across it, by the depth there, so that
/// they see the fluid as behind a face that never moved, and the distances by which walls extrapolate
/// (wall_extrapolation.hpp) stay as they are. What the face pushes out at the other side drops out. Where
/// both of two opposite faces are worn, each particle goes with the nearer one, and what crosses the middle
/// drops out.
///
/// The fluid takes as many rows more before the face as come nearest to the depth. What is left, at most half
/// a spacing, widens or narrows the rows of the column evenly from end to end, with their volumes, so that
/// the shape is continuous in the depth and the fluid has the area that is there.
///
/// Faces are taken as straight along their axis: slopes and bends of the depth should be gentle over a
/// spacing. Surface normals and areas are those of the box.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/fill.hpp"

namespace toryu::fluid {

/// Where the particles of `wall` stand that have their places at `points`; nothing for one that drops out.
std::vector<std::optional<Vec>> worn_places(const Wall& wall, const std::vector<Vec>& points);

/// Whether some of `walls` are.
bool any_is_worn(const std::vector<Wall>& walls);

/// Widens the fluid's `filling` to the worn faces of `walls`. `home` gets for each particle a place in the
/// region to which it belongs.
void fill_worn_space(Filling& filling, std::vector<Vec>& home, const std::vector<Wall>& walls,
                     double spacing);

/// A sentence for each wall that is left thinner than the fluid sees, `reach` [m].
std::vector<std::string> thin_remains(const std::vector<Wall>& walls, double reach);

}  // namespace toryu::fluid
