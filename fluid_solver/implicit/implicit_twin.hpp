/// What a creeping case that `[fluid.similarity]` makes cheap would be by implicit steps, so that --check can
/// tell what either takes.
#pragma once

#include <optional>
#include <string>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

/// The same medium at its own density, with the sound speed that changes the density by the same share under
/// the pressure drop. Nothing where the case has no similarity, or asks for what the implicit model has not.
std::optional<Parameters> implicit_twin(const Parameters& as_read, const Scene& scene);

/// Those of its keys that a case needs to become the twin.
std::string keys_of_twin(const Parameters& twin);

}  // namespace toryu::fluid
