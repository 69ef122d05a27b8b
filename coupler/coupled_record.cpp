#include "coupler/coupled_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error/counted.hpp"
#include "common/error/failure.hpp"
#include "common/run/log.hpp"
#include "common/state/serialize.hpp"

namespace toryu::coupling {

CoupledRecord::CoupledRecord(const Settings& settings, const CouplingStart& start)
    : settings_(settings),
      fluid_(start.traits),
      interface_count_(start.interface.size()),
      layer_(start.interface, start.traits),
      work_(start.motion.position),
      frames_due_(settings.frame_interval, 1),
      series_due_(settings.series_interval, 1),
      series_(settings.out, "coupler") {
  if (settings.frame_interval > 0) interface_.emplace(settings.out, start.interface);
  if (settings.coupling.record == Record::every_window) exchange_.emplace(settings.out, start);
}

void CoupledRecord::begin(const InterfaceMotion& motion) {
  if (interface_) interface_->write(0, motion, {});
}

void CoupledRecord::note(const Window& window, const Exchange& done, double elapsed) {
  last_row_ = false;
  last_frame_ = !interface_;
  const bool first = state_.round_trips.empty();
  state_.smallest_window = first ? window.dt : std::min(state_.smallest_window, window.dt);
  state_.largest_window = std::max(state_.largest_window, window.dt);
  note_convergence(window, done);
  note_times(done, elapsed);
  audit(window, done);
  audit_work(window, done);
  check_added_mass(window, done.fluid.load);
}

void CoupledRecord::write(double time, const Window& window, const Exchange& done) {
  last_row_ = settings_.series_interval == 0 || series_due_.reached(time);
  last_frame_ = !interface_ || frames_due_.reached(time);
  if (last_row_) write_series(time, window, done);
  if (interface_ && last_frame_) interface_->write(time, done.solid.motion, done.applied);
  if (exchange_) exchange_->write(window, done.fluid, done.solid);
}

void CoupledRecord::write_last(double time, const Window& window, const Exchange& done) {
  if (!std::exchange(last_row_, true)) write_series(time, window, done);
  if (!std::exchange(last_frame_, true)) interface_->write(time, done.solid.motion, done.applied);
}

void CoupledRecord::note_convergence(const Window& window, const Exchange& done) {
  state_.iterations += done.iterations;
  state_.row.iterations = std::max(state_.row.iterations, done.iterations);
  state_.row.residual = std::max(state_.row.residual, done.residual);
  state_.unconverged_in_a_row = done.converged ? 0 : state_.unconverged_in_a_row + 1;
  if (done.converged) return;
  if (state_.unconverged++ == 0)
    log::warn("window {}: not converged after {}, residual {:.3g}; the summary counts such windows",
              window.number, counted(done.iterations, "iteration"), done.residual);
  if (state_.unconverged_in_a_row < settings_.coupling.implicit->unconverged_windows_to_stop) return;
  throw PhysicsFailure(
      fmt::format("coupling: {} in a row {} not converged in {} each, the last at t = {:.6g} s with "
                  "a residual of {:.3g} (tolerance {:.3g})",
                  counted(state_.unconverged_in_a_row, "window"),
                  state_.unconverged_in_a_row == 1 ? "has" : "have", counted(done.iterations, "iteration"),
                  window.time + window.dt, done.residual, settings_.coupling.implicit->tolerance));
}

void CoupledRecord::note_times(const Exchange& done, double elapsed) {
  state_.round_trips.push_back(elapsed - done.compute);
  state_.fluid_compute += done.fluid_compute;
  state_.solid_compute += done.solid_compute;
  ++state_.row.windows;
  state_.row.round_trip += state_.round_trips.back();
  state_.row.fluid_compute += done.fluid_compute;
  state_.row.solid_compute += done.solid_compute;
}

void CoupledRecord::audit(const Window& window, const Exchange& done) {
  const double error = audit_.compare(done.fluid.load, done.returned, done.applied, done.solid.motion.impulse,
                                      done.solid.impulse_taken, window.dt);
  state_.row.impulse_error = std::max(state_.row.impulse_error, error);
  if (error <= ExchangeAudit::tolerance || state_.warned_of_impulse) return;
  log::warn(
      "window {}: impulse given and taken differ by {:.3g} of the sum of the forces; the largest difference "
      "of the run is in the summary",
      window.number, error);
  state_.warned_of_impulse = true;
}

void CoupledRecord::audit_work(const Window& window, const Exchange& done) {
  work_.note(done.sent, done.interface_start, done.interface_position, done.applied, done.solid.motion,
             done.solid.health.kinetic_energy);
  const Health& solid = done.solid.health;
  work_.note_energies(solid.kinetic_energy + solid.potential_energy, done.fluid.health.kinetic_energy);
  if (!work_.feeds()) return;
  const bool robin = settings_.coupling.scheme == SchemeKind::serial_robin;
  const auto say = [&](const char* what) {
    return fmt::format(
        "window {}, t = {:.6g} s: the exchange feeds the solid: it took {:.3g} J/m of work where the fluid "
        "gave {:.3g}; {}; take scheme = {}'serial_implicit', or more artificial viscosity of the solid, see "
        "cases/pushed_column/window_map.toml",
        window.number, window.time + window.dt, work_.taken(), work_.given(), what,
        robin ? "" : "'serial_robin' or ");
  };
  if (work_.feeds_beyond(settings_.coupling.largest_false_work))
    throw PhysicsFailure(say("that is more than 'largest_false_work' allows"));
  if (!state_.warned_of_work) log::warn("{}", say("its motion is not to be trusted"));
  state_.warned_of_work = true;
}

void CoupledRecord::check_added_mass(const Window& window, const InterfaceLoad& load) {
  const auto ratio = layer_.mass_ratio(load);
  if (!ratio) return;
  state_.lightest_layer = std::min(state_.lightest_layer, *ratio);
  const double least = least_mass_ratio(settings_.coupling.scheme, settings_.solid, fluid_, window.dt);
  if (*ratio >= least || state_.warned_of_mass) return;
  log::warn("window {}: {}", window.number, too_light(*ratio, least));
  state_.warned_of_mass = true;
}

std::vector<Observation> CoupledRecord::row_of(const Parameters& coupling, const Window& window,
                                               const Exchange& done, const Row& since,
                                               const WorkAudit& work) {
  const Vec force = sum_of(done.applied.force) + sum_of(done.applied.friction_force);
  const double windows = since.windows;
  std::vector<Observation> row{{"dt", "s", window.dt},
                               {"window", "1", static_cast<double>(window.number)},
                               {"round_trip", "s", since.round_trip / windows},
                               {"fluid_compute", "s", since.fluid_compute / windows},
                               {"solid_compute", "s", since.solid_compute / windows},
                               {"impulse_error", "1", since.impulse_error},
                               {"work_given", "J/m", work.given()},
                               {"work_taken", "J/m", work.taken()},
                               {"interface_force_x", "N/m", force.x()},
                               {"interface_force_y", "N/m", force.y()},
                               {"fluid_kinetic_energy", "J/m", done.fluid.health.kinetic_energy},
                               {"fluid_potential_energy", "J/m", done.fluid.health.potential_energy},
                               {"solid_kinetic_energy", "J/m", done.solid.health.kinetic_energy},
                               {"solid_potential_energy", "J/m", done.solid.health.potential_energy}};
  if (coupling.scheme == SchemeKind::serial_robin) {
    const Vec in_flight = sum_of(done.solid.motion.impulse);
    row.push_back({"impulse_in_flight_x", "N.s/m", in_flight.x()});
    row.push_back({"impulse_in_flight_y", "N.s/m", in_flight.y()});
  }
  if (coupling.windows_repeat()) {
    row.push_back({"iterations", "1", static_cast<double>(since.iterations)});
    row.push_back({"residual", "1", since.residual});
  }
  return row;
}

void CoupledRecord::write_series(double time, const Window& window, const Exchange& done) {
  series_.write(time, row_of(settings_.coupling, window, done, state_.row, work_));
  state_.row = {};
}

void CoupledRecord::complete() {
  series_.complete();
  if (interface_) interface_->complete();
  if (exchange_) exchange_->complete();
}

void CoupledRecord::write_state(std::ostream& stream) {
  State now = state_;
  now.audit = audit_.state();
  now.work = work_.state();
  now.frames_due = frames_due_.state();
  now.series_due = series_due_.state();
  now.series = series_.state();
  if (interface_) now.interface = interface_->state();
  if (exchange_) now.exchange = exchange_->state();
  write_states(stream, now);
}

void CoupledRecord::read_state(std::istream& stream, double time) {
  read_states(stream, state_);
  audit_.resume(state_.audit);
  work_.resume(state_.work);
  frames_due_.resume(state_.frames_due, time);
  series_due_.resume(state_.series_due, time);
  series_.resume(state_.series);
  if (interface_ && state_.interface) interface_->resume(*state_.interface);
  if (exchange_ && state_.exchange) exchange_->resume(*state_.exchange);
}

void CoupledRecord::report(Summary& summary) const {
  summary.steps = static_cast<long>(state_.round_trips.size());
  summary.smallest_time_step = state_.smallest_window;
  summary.largest_time_step = state_.largest_window;
  summary.particles = {{"interface", static_cast<long>(interface_count_)}};
  if (state_.round_trips.empty()) return;
  auto sorted = state_.round_trips;
  std::sort(sorted.begin(), sorted.end());
  double total = 0;
  for (const double trip : sorted) total += trip;
  summary.figures = {{"largest_impulse_error", audit_.largest()},
                     {"round_trip_median", sorted[sorted.size() / 2]},
                     {"round_trip_99_percent", sorted[sorted.size() * 99 / 100]},
                     {"round_trip_total", total},
                     {"round_trip_share", total / summary.wall_time},
                     {"fluid_compute_total", state_.fluid_compute},
                     {"solid_compute_total", state_.solid_compute},
                     {"work_given", work_.given()},
                     {"work_taken", work_.taken()}};
  if (std::isfinite(state_.lightest_layer))
    summary.figures.emplace_back("lightest_layer", state_.lightest_layer);
  if (!settings_.coupling.windows_repeat()) return;
  summary.figures.emplace_back("iterations", static_cast<double>(state_.iterations));
  summary.figures.emplace_back("unconverged_windows", static_cast<double>(state_.unconverged));
}

}  // namespace toryu::coupling
