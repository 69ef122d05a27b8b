#include "fluid_solver/run_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error/failure.hpp"
#include "common/run/log.hpp"

namespace toryu::fluid {

namespace {

/// Over the sound speed: cases that take ten times the speed they expect, as is the rule, reach 0.13.
constexpr double fast_to_warn_of = 0.15;
constexpr double share_to_warn_of = 0.001;   ///< of the particles, in walls
constexpr std::size_t count_to_warn_of = 3;  ///< and so many
constexpr std::size_t count_to_stop_at = 10;
constexpr double change_to_warn_of = 0.03;  ///< of the mean density
/// Over the energy turned over: walls, whose pressure stores no energy, hold and give back up to 0.13 in a
/// tank that settles.
constexpr double gain_to_warn_of = 0.5;

}  // namespace

void RunWatch::look(const RunFigures& figures) {
  look_at_speed(figures);
  look_at_walls(figures);
  look_at_density(figures);
  look_at_energy(figures);
}

void RunWatch::look_at_speed(const RunFigures& now) {
  if (!(now.fast > fast_to_warn_of * sound_speed_) || std::exchange(state_.told_speed, true)) return;
  log::warn(
      "t = {:.6g} s: a hundredth of the fluid is faster than {:.3g} m/s, {:.2g} of the sound speed of {:g} "
      "m/s and beyond the edge at {:g}: where it is stopped the density changes by 1 % and more; take "
      "[fluid] sound_speed = "
      "{:.2g} or more, ten times the largest speed",
      now.time, now.fast, now.fast / sound_speed_, sound_speed_, fast_to_warn_of, 10 * now.fast);
}

void RunWatch::look_at_walls(const RunFigures& now) {
  const Penetration& found = now.penetration;
  const auto count = static_cast<double>(now.count), inside = static_cast<double>(found.count);
  if (found.count >= count_to_stop_at && inside > limits_.largest_share_in_walls * count)
    throw PhysicsFailure("fluid", -1, now.time,
                         fmt::format("particles inside walls, near ({:.4g}, {:.4g}) m in '{}',",
                                     found.place[0], found.place[1], found.boundary),
                         fmt::format("{}", found.count),
                         fmt::format("{:g} of {} (fluid.limits.largest_share_in_walls)",
                                     limits_.largest_share_in_walls, now.count));
  if (found.count < count_to_warn_of || !(inside > share_to_warn_of * count) ||
      std::exchange(state_.told_walls, true))
    return;
  log::warn(
      "t = {:.6g} s: {} particles of the fluid are inside walls, most of them in '{}', near ({:.4g}, {:.4g}) "
      "m; take a thicker wall, a higher sound speed, a finer fluid or [fluid.wall_repulsion]",
      now.time, found.count, found.boundary, found.place[0], found.place[1]);
}

void RunWatch::look_at_density(const RunFigures& now) {
  if (state_.start_density == 0) state_.start_density = now.mean_density;
  const double change = now.mean_density / state_.start_density - 1;
  if (std::abs(change) > limits_.largest_mean_density_change)
    throw PhysicsFailure(
        "fluid", -1, now.time, "change of the mean density since the start", fmt::format("{:.3g}", change),
        fmt::format("{:g} (fluid.limits.largest_mean_density_change)", limits_.largest_mean_density_change));
  if (!(std::abs(change) > change_to_warn_of) || std::exchange(state_.told_density, true)) return;
  log::warn(
      "t = {:.6g} s: the mean density of the fluid has crept from {:.6g} to {:.6g} kg/m3, by {:.2g} %: its "
      "pressure drifts with it; if no piston compresses it take a higher sound speed, shorter steps, or "
      "another treatment of what moves particles ([fluid.particle_shifting], [fluid.tensile_control])",
      now.time, state_.start_density, now.mean_density, 100 * change);
}

void RunWatch::look_at_energy(const RunFigures& now) {
  state_.turned_over = std::max(state_.turned_over, now.turned_over);
  state_.lowest_gain = std::min(state_.lowest_gain, now.gained);
  const double gain = now.gained - state_.lowest_gain, most = state_.turned_over + now.least_energy;
  if (gain > limits_.largest_energy_gain * most)
    throw PhysicsFailure("fluid", -1, now.time, "energy from nowhere [J/m]", fmt::format("{:.4g}", gain),
                         fmt::format("{:.4g}, fluid.limits.largest_energy_gain times the largest turned over",
                                     limits_.largest_energy_gain * most));
  if (!(gain > gain_to_warn_of * most) || std::exchange(state_.told_energy, true)) return;
  log::warn(
      "t = {:.6g} s: the fluid has gained {:.3g} J/m that no boundary gave it, {:.2g} of the largest energy "
      "it has turned over; take shorter steps (time_step_share), [fluid.density_diffusion] or some "
      "viscosity, "
      "a finer fluid; energy_remainder and dissipated_by_walls in fluid.csv tell where it comes from",
      now.time, gain, gain / most);
}

}  // namespace toryu::fluid
