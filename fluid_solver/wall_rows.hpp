/// Rows of particles between faces: which walls need them in line with the fluid, and what does not fit.
#pragma once

#include <string>
#include <vector>

#include "common/scene/fill.hpp"
#include "common/scene/period.hpp"
#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

/// Regions and holes of the fluid.
Blocks blocks_of(const Parameters& parameters);

/// Cuts these bodies out of the fluid, besides its holes.
void leave_out(const std::vector<Box>& bodies, Parameters& parameters);

/// Cuts the images of its holes out of the fluid as well, where holes go beyond a side at which space repeats
/// itself.
void repeat_holes(const Period& period, Parameters& parameters);

/// Particles of a wall: those that fit its outline; of a box on the lattice through its smallest corner. In
/// rows between its faces, in line with the fluid's, where fluid at rest on the wall would find those off by
/// more than a tenth of a spacing: where they end beside a face that the fluid starts on, or are out of line
/// with the fluid's under its weight or where the fluid is not on a lattice itself.
Filling fill_wall(const Wall& wall, const Parameters& parameters, const Vec& gravity);

/// A sentence for each wall of too few rows to fit them to the face that fluid starts on.
std::vector<std::string> misplaced_faces(const std::vector<Wall>& walls, const Parameters& parameters);

/// Where rows of the fluid do not fit between faces, and sizes that would.
std::string misfit_text(const Misfit& misfit, double spacing);

}  // namespace toryu::fluid
