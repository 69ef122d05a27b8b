/// Bodies of which one is rigid do not push each other: where particles of two come too near the run ends.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/vector.hpp"

namespace toryu::solid {

/// Particles of two bodies that are nearer, over the spacing: the bodies have met.
constexpr double least_gap = 0.5;

/// The first particle at `x` [m] that is nearer than `distance` [m] to one of another body, and that one.
std::optional<std::pair<std::uint32_t, std::uint32_t>> meeting_particles(
    const std::vector<Vec>& x, const std::vector<std::uint32_t>& body_of, double distance);

}  // namespace toryu::solid
