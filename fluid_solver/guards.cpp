#include "fluid_solver/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid_solver/taken_places.hpp"

namespace toryu::fluid {

namespace {

constexpr int least_thin_particles = 16;

/// g H of the regions together [m2/s2].
double weight_of_depth(const Parameters& p, const Vec& gravity) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const auto& region : p.regions) {
    const double middle = 0.5 * gravity.dot(region.box.min + region.box.max);
    const double half = 0.5 * gravity.cwiseAbs().dot(region.box.max - region.box.min);
    lowest = std::min(lowest, middle - half);
    highest = std::max(highest, middle + half);
  }
  return std::max(highest - lowest, 0.0);
}

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

std::optional<std::string> beyond_coarsest_work_piece(double spacing, const Parameters& p) {
  if (!(p.friction || p.removal) || spacing < 1.01 * p.spacing) return {};
  return fmt::format(
      "the work piece's particles stand {:.3g} m apart, the fluid's {:.3g} m: friction and removal will be "
      "far "
      "too small; take a spacing of the solid that is no larger, see cases/abrasive_flow/README.md",
      spacing, p.spacing);
}

double wall_speed_at_start(const std::vector<Wall>& walls) {
  double fastest = 0;
  for (const Wall& wall : walls) {
    if (!wall.motion) continue;
    Eigen::Index across;
    (wall.box.max - wall.box.min).minCoeff(&across);
    fastest = std::max(fastest, std::abs(wall.motion->velocity_at(0)[across]));
  }
  return fastest;
}

std::vector<std::string> beyond_edges(const Parameters& p, const Start& start) {
  std::vector<std::string> said;
  if (p.time_step_share > time_step_edge(p))
    said.push_back(
        fmt::format("time_step_share {:g} is beyond the edge of stability at {:.2g}; see "
                    "cases/hydrostatic_tank/time_step_map.toml",
                    p.time_step_share, time_step_edge(p)));
  if (p.sound_speed < 10 * start.speed)
    said.push_back(fmt::format(
        "sound_speed {:g} m/s is below ten times the largest speed at the start, {:.3g} m/s: the density "
        "will change by more than 1 %",
        p.sound_speed, start.speed));
  if (start.wall_speed > start_edge * p.sound_speed)
    said.push_back(
        fmt::format("a wall starts at once at {:.3g} m/s, {:.2g} of the sound speed and beyond the edge at "
                    "{:g}: pressures will be far off; see cases/retreating_piston/start_map.toml",
                    start.wall_speed, start.wall_speed / p.sound_speed, start_edge));
  const double edge = (p.hydrostatic_start ? depth_edge_hydrostatic : depth_edge_at_once) *
                      std::sqrt(weight_of_depth(p, start.gravity));
  if (p.sound_speed < edge)
    said.push_back(
        fmt::format("sound_speed {:g} m/s is below the edge of {:.3g} m/s for fluid that deep{}; see "
                    "cases/hydrostatic_tank/start_map.toml",
                    p.sound_speed, edge,
                    p.hydrostatic_start ? "" : " on which gravity sets in at once ('hydrostatic_start')"));
  return said;
}

}  // namespace toryu::fluid
