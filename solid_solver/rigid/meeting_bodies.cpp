#include "solid_solver/rigid/meeting_bodies.hpp"

#include "common/sph/sorted_points.hpp"

namespace toryu::solid {

std::optional<std::pair<std::uint32_t, std::uint32_t>> meeting_particles(
    const std::vector<Vec>& x, const std::vector<std::uint32_t>& body_of, double distance) {
  std::optional<std::pair<std::uint32_t, std::uint32_t>> met;
  const SortedPoints points(x, distance);
  for (std::uint32_t i = 0; i < x.size() && !met; ++i)
    points.near(x[i], distance, [&](std::uint32_t j) {
      if (!met && body_of[i] != body_of[j]) met.emplace(i, j);
    });
  return met;
}

}  // namespace toryu::solid
