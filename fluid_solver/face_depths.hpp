/// How far the particles of a body lie behind its faces.
#pragma once

#include "common/scene/outline.hpp"
#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

/// Of `points` of one body on a lattice of `spacing` [m], which repeats itself by `shifts` (Period); `far`
/// [m] where the body goes on beyond that.
FaceDepths lattice_face_depths(const std::vector<Vec>& points, double spacing, double far,
                               const std::vector<Vec>& shifts = {Vec::Zero()});

/// The same where some of the points fit an outline, each its own: that alone is their face.
FaceDepths face_depths(const std::vector<Vec>& points, const std::vector<const Outline*>& outlines,
                       double spacing, double far, const std::vector<Vec>& shifts = {Vec::Zero()});

}  // namespace toryu::fluid
