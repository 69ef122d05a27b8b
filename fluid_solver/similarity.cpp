#include "fluid_solver/similarity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

namespace {

/// Of a closed medium, over the pressure drop: the leading half would else be under suction.
constexpr double background_share = 0.65;
/// Of the mean speed: friction transmits 99.9 % of mu_A p at that speed.
constexpr double regularisation_share = 0.05;
/// Crossings of the medium by sound in which pistons may come to their speed.
constexpr double gentle_crossings = 4;
/// Pressure over the wall's shear stress that rows bear without sticking to one another, but for Wendland C2
/// at h/d_0 = 2 (cases/slit_channel, "Under a high pressure").
constexpr double bearable_pressure = 30;
/// Reynolds number below which inertia changes a flow by less than a thousandth.
constexpr double creeping_reynolds_number = 0.01;
/// Of the slowest part of a starting flow between plates, pi^2 nu/w^2 (the series of cases/poiseuille), and
/// in a tube, (2 j_0)^2 nu/w^2 with the first zero 2.405 of the Bessel function J_0 (Szymanski 1932).
constexpr double profile_rate(Geometry geometry) {
  return geometry == Geometry::plane ? 9.87 : 23.13;
}
constexpr double largest_mach_number = 0.1;
/// Difference of the pistons' pressures over the drop by which sound and background pressure are chosen.
constexpr double largest_share_of_drop = 1.5;

/// In which the pressure would change by all that its table has at the steepest of it [s].
double shortest_ramp(const Press& press) {
  const auto& rows = press.force.empty() ? press.pressure : press.force;
  const auto [least, most] =
      std::minmax_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (rows[k][1] != rows[k - 1][1])
      shortest = std::min(shortest, ((*most)[1] - (*least)[1]) / std::abs(rows[k][1] - rows[k - 1][1]) *
                                        (rows[k][0] - rows[k - 1][0]));
  return shortest;
}

/// Largest difference of the pressures of two pressed walls at `time` [Pa].
double difference_of_presses(const Scene& scene, double time) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Wall& wall : scene.walls)
    if (wall.press) {
      const double p = wall.press->pressure_at(time, pressing_area(wall, scene.geometry));
      least = std::min(least, p), most = std::max(most, p);
    }
  return std::max(most - least, 0.0);
}

double largest_difference_of_presses(const Scene& scene) {
  double largest = 0;
  for (const Wall& wall : scene.walls)
    if (wall.press)
      for (const auto* rows : {&wall.press->pressure, &wall.press->force})
        for (const auto& row : *rows) largest = std::max(largest, difference_of_presses(scene, row[0]));
  return largest;
}

/// In which a wall would gain its largest speed, or its pressure, at the steepest of its table; the shortest
/// of all, 0 where a wall starts with a speed or pistons with unlike pressures [s].
double shortest_ramp(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  if (difference_of_presses(scene, 0) > 0) shortest = 0;
  for (const Wall& wall : scene.walls) {
    if (wall.press) shortest = std::min(shortest, shortest_ramp(*wall.press));
    if (!wall.motion) continue;
    if (!wall.motion->position.empty() || !wall.motion->sine.empty() || wall.motion->turns()) {
      const MotionExtremes most = extremes(*wall.motion, corners_of(wall.box), scene.end_time);
      if (most.acceleration > 0) shortest = std::min(shortest, most.speed / most.acceleration);
      continue;
    }
    const auto& rows = wall.motion->velocity;
    const double largest = largest_speed(*wall.motion, {}, scene.end_time);
    if (!wall.motion->velocity_at(0).isZero(0)) shortest = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
      const double change =
          std::abs(wall.motion->speed) * std::hypot(rows[k][1] - rows[k - 1][1], rows[k][2] - rows[k - 1][2]);
      if (change > 0)
        shortest = std::min(shortest, largest / change * wall.motion->time * (rows[k][0] - rows[k - 1][0]));
    }
  }
  return shortest;
}

double longest_side(const std::vector<Region>& regions) {
  return sides(regions).maxCoeff();
}

/// What the case asks for that is a matter of inertia.
const char* key_of_inertia(const Parameters& p) {
  if (p.initial_flow) return "fluid.initial_flow";
  if (p.surface_tension) return "fluid.surface_tension";
  if (p.viscoelasticity) return "fluid.viscoelasticity";
  if (p.central_force) return "fluid.central_force";
  for (const Region& region : p.regions)
    if (!region.velocity.isZero(0)) return "fluid.region";
  return nullptr;
}

}  // namespace

void describe(ParameterTable& table, Similarity& similarity) {
  const auto size = [&](const std::string& key, double& value, const std::string& unit,
                        const std::string& help) {
    table.number(key, value,
                 {.unit = unit, .minimum = 0, .above_minimum = true, .required = true, .help = help});
  };
  size("mean_speed", similarity.mean_speed, "m/s", "of the medium in the narrowest passage");
  size("passage_width", similarity.passage_width, "m", "of that passage; about an axis the diameter");
  size("passage_length", similarity.passage_length, "m",
       "of that passage, what else the medium passes counted in: with the wall's shear stress it gives the "
       "pressure drop");
  table.number("reynolds_number", similarity.reynolds_number,
               {.minimum = 0,
                .maximum = 2,
                .above_minimum = true,
                .help = "that is computed, rho U w/eta at the wall's viscosity; the larger, the faster and "
                        "the less exact"});
  table.number("compression", similarity.compression,
               {.minimum = 0,
                .maximum = 0.05,
                .above_minimum = true,
                .help = "change of the density over the pressure drop, which sets the sound speed"});
}

SimilarMedium similar_medium(const Parameters& p, Geometry geometry) {
  const Similarity& s = *p.similarity;
  SimilarMedium similar{.passage = passage_flow(p, s.mean_speed, s.passage_width, geometry)};
  const double sheared = 1 - similar.passage.slip_speed / s.mean_speed;
  const double inertia = s.mean_speed * s.passage_width / (sheared * similar.passage.wall_viscosity);
  similar.pressure_drop = (geometry == Geometry::plane ? 2 : 4) * similar.passage.wall_stress *
                          s.passage_length / s.passage_width;
  similar.density = s.reynolds_number / inertia;
  similar.sound_speed = p.sound_speed > 0
                            ? p.sound_speed
                            : std::sqrt(similar.pressure_drop / (s.compression * similar.density));
  similar.real_reynolds_number = p.density * inertia;
  return similar;
}

BackgroundPressure similar_background(const SimilarMedium& similar) {
  return {.pressure = background_share * similar.pressure_drop};
}

std::vector<SimilarityFault> similarity_faults(const Parameters& p, Geometry geometry, bool with_solid) {
  if (!p.similarity) return {};
  if (with_solid)
    return {{"fluid.similarity",
             "an elastic solid is not coupled to a fluid whose density is chosen: its added mass would be "
             "wrong"}};
  if (!is_viscous(p))
    return {{"fluid.similarity",
             "a creeping flow needs a viscosity: [fluid.laminar_viscosity], [fluid.power_law], "
             "[fluid.herschel_bulkley] or [fluid.carreau]"}};
  if (p.artificial_viscosity)
    return {{"fluid.artificial_viscosity",
             "artificial viscosity grows with the density that [fluid.similarity] chooses and would thicken "
             "the medium: leave it out"}};
  if (const char* key = key_of_inertia(p))
    return {{key, "it depends on the inertia that [fluid.similarity] changes: leave one of the two out"}};
  const SimilarMedium similar = similar_medium(p, geometry);
  const double real = similar.real_reynolds_number;
  for (const double value : {similar.pressure_drop, similar.density, similar.sound_speed})
    if (!(value > 0 && std::isfinite(value)))
      return {{"fluid.similarity",
               fmt::format("the passage would have a pressure drop of {:g} Pa, a density of {:g} kg/m3 and a "
                           "sound speed of {:g} m/s",
                           similar.pressure_drop, similar.density, similar.sound_speed)}};
  if (real > p.similarity->reynolds_number)
    return {{"fluid.similarity",
             fmt::format("the medium's own Reynolds number {:.3g} exceeds the 'reynolds_number' {:g}: its "
                         "inertia counts, leave [fluid.similarity] out",
                         real, p.similarity->reynolds_number)}};
  return {};
}

std::string make_similar(Parameters& p, Scene& scene) {
  const SimilarMedium similar = similar_medium(p, scene.geometry);
  const double factor = similar.density / p.density;
  scene.gravity /= factor;
  p.density = similar.density;
  p.sound_speed = similar.sound_speed;
  if (!p.background_pressure) p.background_pressure = similar_background(similar);
  if (p.friction && p.friction->regularisation_speed == 0)
    p.friction->regularisation_speed = regularisation_share * p.similarity->mean_speed;
  return fmt::format(
      "similarity: in the passage {:.4g} 1/s, {:.4g} Pa s and {:.4g} Pa at the wall, pressure drop {:.4g} "
      "Pa; Re {:.2g}, computed at {:g} with {:.4g} times the density and a sound speed of {:.4g} m/s (Mach "
      "number {:.2g}); the pressure builds up in some {:.2g} s, the profile in some {:.2g} s, "
      "pistons may start in {:.2g} s",
      similar.passage.wall_shear_rate, similar.passage.wall_viscosity, similar.passage.wall_stress,
      similar.pressure_drop, similar.real_reynolds_number, p.similarity->reynolds_number, factor,
      similar.sound_speed, p.similarity->mean_speed / similar.sound_speed,
      similar.pressure_drop / (similar.density * similar.sound_speed * similar.sound_speed) *
          longest_side(p.regions) / p.similarity->mean_speed,
      p.similarity->reynolds_number * p.similarity->passage_width /
          (profile_rate(scene.geometry) * p.similarity->mean_speed),
      gentle_crossings * longest_side(p.regions) / similar.sound_speed);
}

std::optional<std::string> creeping(const Parameters& p, const Scene& scene) {
  const double U = largest_wall_speed(scene);
  if (p.similarity || p.model == Model::implicit || U == 0 || !scene.gravity.isZero(0) || !is_viscous(p) ||
      p.artificial_viscosity || key_of_inertia(p))
    return {};
  const double width = passage_width(p.regions, scene.geometry);
  const double nu = passage_flow(p, U, width, scene.geometry).wall_viscosity / p.density, Re = U * width / nu;
  const double settling = width * width / (profile_rate(scene.geometry) * nu);  // of the profile [s]
  if (!(Re < creeping_reynolds_number && settling < 0.1 * shortest_ramp(scene))) return {};
  return fmt::format(
      "the flow creeps, Re {:.2g} at the walls' {:g} m/s over the fluid's {:g} m: its inertia does nothing "
      "but shorten the steps; with [fluid.similarity] it is computed {:.2g} times heavier",
      Re, U, width, Similarity{}.reynolds_number / Re);
}

std::vector<std::string> similarity_warnings(const Parameters& p, const Scene& scene) {
  if (!p.similarity) return {};
  std::vector<std::string> said;
  const double crossing = longest_side(p.regions) / p.sound_speed, ramp = shortest_ramp(scene);
  if (ramp < gentle_crossings * crossing)
    said.push_back(fmt::format(
        "a wall comes to its speed or pressure within {:.3g} s, and sound crosses the medium in {:.3g} s: "
        "take {:g} times that, or the medium sloshes",
        ramp, crossing, gentle_crossings));
  const double mach = p.similarity->mean_speed / p.sound_speed, pushed = largest_wall_speed(scene);
  if (mach > largest_mach_number)
    said.push_back(
        fmt::format("the mean speed in the passage is {:.2g} of the sound speed of {:.4g} m/s: "
                    "the density will change with it; see the passage's length and 'sound_speed'",
                    mach, p.sound_speed));
  if (pushed > 1.01 * p.similarity->mean_speed)
    said.push_back(
        fmt::format("walls move at {:.4g} m/s, faster than the 'mean_speed' {:.4g} m/s in the narrowest "
                    "passage: the pressure drop, and with it the sound speed, may be far too low",
                    pushed, p.similarity->mean_speed));
  const SimilarMedium similar = similar_medium(p, scene.geometry);
  const double difference = largest_difference_of_presses(scene);
  if (difference > largest_share_of_drop * similar.pressure_drop)
    said.push_back(
        fmt::format("pistons press with a difference of {:.4g} Pa, the passage takes {:.4g} Pa at the "
                    "'mean_speed': the medium will be compressed more, and flow faster",
                    difference, similar.pressure_drop));
  const double load =
      (p.background_pressure->pressure + 0.5 * similar.pressure_drop) / similar.passage.wall_stress;
  if (load > bearable_pressure && (p.kernel != KernelForm::wendland_c2 || p.smoothing_ratio < 1.99))
    said.push_back(
        fmt::format("pressures reach {:.3g} times the wall's shear stress, under which rows of particles "
                    "stick to one another: take kernel = \"wendland_c2\" and smoothing_ratio = 2.0",
                    load));
  return said;
}

}  // namespace toryu::fluid
