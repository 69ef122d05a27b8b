#include "fluid_solver/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fluid_solver/taken_places.hpp"

namespace toryu::fluid {

namespace {
constexpr int least_thin_particles = 16;
}  // namespace

double time_step_edge(const Parameters& p) {
  if (p.integrator == Integrator::symplectic) return 6.7;
  const double delta = p.density_diffusion ? p.density_diffusion->delta : 0.0;
  return std::max(2.6 * std::cbrt(10 * delta), 0.8);
}

double thinnest_wall(const Parameters& p) {
  return 2.0 * p.h() - p.spacing;
}

std::optional<std::string> beyond_thinnest(const Boundary& body, double spacing, const Parameters& p) {
  std::vector<Vec> places(body.count);
  for (std::size_t k = 0; k < body.count; ++k) places[k] = at(body.x, k);
  TakenPlaces taken(0.6 * spacing);
  taken.take(places, body.name);
  const double least = thinnest_wall(p);
  const auto thickness = [&](const Vec& x, const Vec& step) {
    double sum = spacing;
    for (const double side : {-1.0, 1.0})
      for (Vec site = x + side * step; sum < least && taken.taken(site); site += side * step) sum += spacing;
    return sum;
  };
  int thin = 0;
  double found = least;
  for (const Vec& x : places) {
    const double here = std::min(thickness(x, spacing * Vec::UnitX()), thickness(x, spacing * Vec::UnitY()));
    thin += here < 0.999 * least;
    found = std::min(found, here);
  }
  if (thin < least_thin_particles) return {};
  return fmt::format(
      "'{}' is {:.3g} m thick in places, and below 2h - d0 = {:.3g} m water on either side of a wall "
      "acts on that on the other; see cases/thin_wall/thin_wall_map.toml",
      body.name, found, least);
}

std::vector<std::string> beyond_edges(const Parameters& p, double speed) {
  std::vector<std::string> said;
  if (p.time_step_share > time_step_edge(p))
    said.push_back(
        fmt::format("time_step_share {:g} is beyond the edge of stability at {:.2g}; see "
                    "cases/hydrostatic_tank/time_step_map.toml",
                    p.time_step_share, time_step_edge(p)));
  if (p.sound_speed < 10 * speed)
    said.push_back(fmt::format(
        "sound_speed {:g} m/s is below ten times the largest speed at the start, {:.3g} m/s: the density "
        "will change by more than 1 %",
        p.sound_speed, speed));
  return said;
}

}  // namespace toryu::fluid
