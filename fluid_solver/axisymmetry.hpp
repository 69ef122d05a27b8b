/// What a case may not ask for about an axis.
#pragma once

#include "fluid_solver/start_checks.hpp"

namespace toryu::fluid {

/// Fluid beyond the axis; each term and option that is of the plane alone.
std::vector<StartFault> axis_faults(const Parameters& parameters, const Scene& scene);

}  // namespace toryu::fluid
