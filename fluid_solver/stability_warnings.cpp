#include "fluid_solver/stability_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error/counted.hpp"
#include "common/scene/period.hpp"
#include "common/sph/sorted_points.hpp"
#include "fluid_solver/passage_flow.hpp"
#include "fluid_solver/start_checks.hpp"

namespace toryu::fluid {

static_assert(dim == 2, "thickness is that along x and y");

namespace {

constexpr int least_thin_particles = 16;
/// h over the distance of rings that a round passage has drawn inward: at 1.15 the pressure drop rises with
/// the stroke, by 5 % from 70 to 190 ms, at 1.73 it stays (cases/axisymmetric_throat).
constexpr double least_ratio_of_rings = 1.7;

std::vector<Vec> places_of(const auto& particles) {
  std::vector<Vec> places(particles.count);
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = at(particles.x, k);
  return places;
}

/// Particles of one body, and what else fills the space around it, which repeats itself by `shifts` (Period).
class Bodies {
 public:
  Bodies(std::vector<Vec> places, const std::vector<Boundary>& others, double spacing,
         const std::vector<Vec>& shifts)
      : places_(std::move(places)), spacing_(spacing) {
    const auto take = [&](const std::vector<Vec>& body) {
      bodies_.emplace_back(shifts.size() > 1 ? with_images(body, shifts) : body, nearest());
    };
    take(places_);
    for (const auto& other : others) take(places_of(other));
  }

  /// The least thickness along x or y [m], if enough particles have one below `least` [m].
  std::optional<double> thinnest(double least) const {
    int thin = 0;
    double found = least;
    for (const Vec& x : places_) {
      const double here = std::min(thickness(x, Vec::UnitX(), least), thickness(x, Vec::UnitY(), least));
      thin += here < 0.999 * least;
      found = std::min(found, here);
    }
    if (thin < least_thin_particles) return {};
    return found;
  }

 private:
  /// A site that is nearer to a particle is filled [m].
  double nearest() const { return 0.6 * spacing_; }

  double thickness(const Vec& x, const Vec& direction, double least) const {
    const auto filled = [&](const Vec& site) {
      return std::any_of(bodies_.begin(), bodies_.end(), [&](const SortedPoints& body) {
        bool found = false;
        body.near(site, nearest(), [&](std::uint32_t) { found = true; });
        return found;
      });
    };
    double sum = spacing_;
    for (const double step : {-spacing_, spacing_})
      for (Vec site = x + step * direction; sum < 0.999 * least && filled(site); site += step * direction)
        sum += spacing_;
    return sum;
  }

  std::vector<Vec> places_;
  double spacing_;
  std::vector<SortedPoints> bodies_;  ///< that and the others
};

bool damps_noise(const Parameters& p) {
  return p.artificial_viscosity || is_viscous(p) || (p.density_diffusion && p.density_diffusion->delta > 0);
}

/// g H of the regions together [m2/s2].
double weight_of_depth(const Parameters& p, const Vec& gravity) {
  if (p.regions.empty() || gravity.isZero(0)) return 0;
  const auto [lowest, highest] = heights(p.regions, gravity);
  return gravity.norm() * (highest - lowest);
}

}  // namespace

Vec gravity_on_columns(const Scene& scene) {
  Vec gravity = scene.gravity;
  if (scene.periodic == Periodic::x || scene.periodic == Periodic::xy) gravity[0] = 0;
  if (scene.periodic == Periodic::y || scene.periodic == Periodic::xy) gravity[1] = 0;
  return gravity;
}

double time_step_edge(const Parameters& p) {
  if (p.integrator == Integrator::symplectic) return 6.7;
  const double delta = p.density_diffusion ? p.density_diffusion->delta : 0.0;
  return std::max(2.6 * std::cbrt(10 * delta), 0.8);
}

double thinnest_wall(const Parameters& p) {
  return 2.0 * p.h() - p.spacing;
}

std::optional<std::string> beyond_thinnest(const Boundary& body, double spacing, const Parameters& p,
                                           const std::vector<Vec>& shifts) {
  const Bodies bodies(places_of(body), {}, spacing, shifts);
  const double least = thinnest_wall(p);
  if (const auto found = bodies.thinnest(least))
    return fmt::format(
        "'{}' is {:.3g} m thick in places{}, and below 2h - d0 = {:.3g} m water on either side of a wall "
        "acts on that on the other; see cases/thin_wall/thin_wall_map.toml",
        body.name, *found,
        !body.is_interface() && *found < 1.5 * spacing
            ? ", a single row of particles, through which fluid leaks"
            : "",
        least);
  return {};
}

std::optional<std::string> beyond_thinnest_jet(const Particles& fluid, const std::vector<Boundary>& walls,
                                               double spacing, const std::vector<Vec>& shifts) {
  const Bodies bodies(places_of(fluid), walls, spacing, shifts);
  if (const auto found = bodies.thinnest(3 * spacing))
    return fmt::format(
        "the fluid is {} wide in places: a jet so narrow bounces off a wall with up to half "
        "of its momentum; see cases/thin_jet/near_singular_map.toml",
        counted(std::lround(*found / spacing), "particle"));
  return {};
}

std::optional<std::string> beyond_coarsest_work_piece(double spacing, const Parameters& p) {
  if (!(p.friction || p.removal) || spacing < 1.01 * p.spacing) return {};
  return fmt::format(
      "the work piece's particles stand {:.3g} m apart, the fluid's {:.3g} m: friction and removal will be "
      "far too small; take a spacing of the solid that is no larger, see cases/abrasive_flow/README.md",
      spacing, p.spacing);
}

std::optional<std::string> removal_by_grain_length(const Parameters& p) {
  if (!p.removal || p.wall_slip || p.wall_model.slip != WallSlip::no_slip) return {};
  return fmt::format(
      "under no slip nothing slides along the work pieces, and the removed depth is in proportion to "
      "'grain_length', "
      "which is {:g} m unless the case says another: state it in [fluid.removal], or give the medium's slip, "
      "[fluid.wall_slip], by which the sliding speed comes of the flow",
      p.removal->grain_length);
}

std::optional<std::string> beyond_thinnest_rings(const Parameters& p, const Scene& scene) {
  if (!p.similarity || scene.geometry == Geometry::plane) return {};
  const double wide = passage_width(p.regions, scene.geometry), narrow = p.similarity->passage_width;
  const double farther = std::sqrt(std::max(wide / narrow, 1.0));  // in the plane, by area
  if (p.smoothing_ratio >= least_ratio_of_rings * farther) return {};
  return fmt::format(
      "medium that is drawn from a diameter of {:g} m into one of {:g} m keeps its mass in smaller rings, "
      "which "
      "stand {:.2g} times as far apart: the kernel has h/d0 {:.2g} there, and below {:g} the pressure drop "
      "rises "
      "with the stroke; take smoothing_ratio = {:.2g}, see cases/axisymmetric_throat",
      wide, narrow, farther, p.smoothing_ratio / farther, least_ratio_of_rings,
      std::ceil(10 * least_ratio_of_rings * farther) / 10);
}

namespace {

/// Of the corners of a wall that turns, against fluid at rest at the start unless that flows.
void note_turning(Blow& hardest, const Wall& wall, double end_time, double response, bool flows) {
  for (const double t : wall.motion->knots(end_time)) {
    if (t == 0 && flows) continue;
    const Pose now = wall.motion->pose_at(t), before = wall.motion->pose_at(t - response);
    for (const Vec& corner : corners_of(wall.box)) {
      const Vec v = now.velocity_of(corner), v_before = before.velocity_of(corner);
      const double speed = t == 0 ? v.norm() : (v - v_before).norm();
      if (speed > hardest.speed) hardest = {speed, wall.name, t};
    }
  }
}

}  // namespace

Blow hardest_blow(const Scene& scene, const Parameters& p) {
  Blow hardest;
  const double response = 2 * p.h() / p.sound_speed;  // in which sound crosses the kernel
  for (const Wall& wall : scene.walls) {
    if (!wall.motion) continue;
    if (wall.motion->turns() && !wall.box.round) {
      note_turning(hardest, wall, scene.end_time, response, p.initial_flow.has_value());
      continue;
    }
    Eigen::Index across;
    (wall.box.max - wall.box.min).minCoeff(&across);
    const auto note = [&, axis = across](double time, const Vec& before) {
      const double speed = std::abs((wall.motion->velocity_at(time) - before)[axis]);
      if (speed > hardest.speed) hardest = {speed, wall.name, time};
    };
    // at rest or with the fluid: what is nearer
    const auto nearest =
        std::min_element(p.regions.begin(), p.regions.end(), [&](const auto& a, const auto& b) {
          const Vec v = wall.motion->velocity_at(0);
          return (a.velocity - v).norm() < (b.velocity - v).norm();
        });
    note(0, nearest == p.regions.end() ? Vec(Vec::Zero()) : nearest->velocity);
    for (const auto& row : wall.motion->velocity) {
      const double time = row[0] * wall.motion->time;
      // the largest change of a table within a given time begins or ends at one of its rows
      for (const double end : {time, time + response})
        if (end - response >= 0 && end <= scene.end_time) note(end, wall.motion->velocity_at(end - response));
    }
  }
  return hardest;
}

std::vector<std::string> stability_warnings(const Parameters& p, const Start& start) {
  std::vector<std::string> said;
  const bool is_explicit = p.model == Model::weakly_compressible;  // implicit steps have no such edge
  if (is_explicit && p.time_step_share > time_step_edge(p))
    said.push_back(
        fmt::format("time_step_share {:g} is beyond the edge of stability at {:.2g}; see "
                    "cases/hydrostatic_tank/time_step_map.toml",
                    p.time_step_share, time_step_edge(p)));
  if (!damps_noise(p))
    said.emplace_back(
        "neither [fluid.density_diffusion] nor a viscosity damps the noise of the pressure: it grows until "
        "the run fails, in water at rest too and whatever the step");
  if (p.sound_speed < 10 * start.speed)
    said.push_back(fmt::format(
        "sound_speed {:g} m/s is below ten times the largest speed at the start, {:.3g} m/s: the density "
        "will change by more than 1 %",
        p.sound_speed, start.speed));
  if (start.blow.speed > start_edge * p.sound_speed)
    said.push_back(fmt::format(
        "wall '{}' changes its speed at once by {:.3g} m/s at t = {:.4g} s, {:.2g} of the sound speed "
        "and beyond the edge at {:g}: pressures will be far off; let it take longer, see "
        "cases/retreating_piston/start_map.toml",
        start.blow.wall, start.blow.speed, start.blow.time, start.blow.speed / p.sound_speed, start_edge));
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
