/// A solid in space that repeats itself ([case] periodic). It goes where it is carried, out of the domain if
/// need be; the fluid finds it by its images. Regions may cross a side of the domain, and those that touch
/// across a period are one: a plate as long as the period has no ends.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/scene/period.hpp"
#include "solid_solver/parameters.hpp"

namespace toryu::solid {

/// What of a solid does not go with space that repeats itself, with the key of the case file.
std::vector<std::pair<std::string, std::string>> periodic_faults(const Parameters& parameters,
                                                                 const Scene& scene);

/// Cuts the images of its holes out of the solid as well, where holes go beyond a side.
void repeat_holes(const Period& period, Parameters& parameters);

}  // namespace toryu::solid
