/// What a case may not have for its fluid to be spread over ranks.
#pragma once

#include <vector>

#include "common/scene/scene.hpp"
#include "fluid_solver/start_checks.hpp"

namespace toryu::fluid {

std::vector<StartFault> rank_faults(const Parameters& parameters, const Scene& scene);

}  // namespace toryu::fluid
