/// What a case may not ask of the implicit model, told before the run by the name of the term.
#pragma once

#include "fluid_solver/parameters.hpp"
#include "fluid_solver/start_checks.hpp"

namespace toryu::fluid {

/// Nothing for another model.
std::vector<StartFault> implicit_faults(const Parameters& parameters, const Scene& scene, bool with_solid);

/// Of a fluid that has a free surface at the start.
StartFault implicit_surface_fault();

}  // namespace toryu::fluid
