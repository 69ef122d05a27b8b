#include "coupler/coupled_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/failure.hpp"
#include "common/run/log.hpp"

namespace toryu::coupling {

double window_length(double left, int steps, double limit) {
  const double longest = steps * limit;
  if (left <= longest) return left;
  return left < 2 * longest ? 0.5 * left : longest;
}

bool Due::at(double time) {
  if (interval_ <= 0) return true;
  if (time < interval_ * static_cast<double>(next_) * (1 - 1e-12)) return false;
  next_ = static_cast<long>(std::floor(time / interval_ * (1 + 1e-12))) + 1;
  return true;
}

CoupledRun::CoupledRun(Settings settings, CouplerLink& link)
    : settings_(std::move(settings)),
      link_(link),
      frame_due_(settings_.frame_interval),
      series_due_(settings_.series_interval) {}

void CoupledRun::run(const CouplerLink::Start& start) {
  scheme_ = make_scheme(settings_.coupling, link_, start);
  time_step_limit_ = start.traits.time_step_limit;
  fluid_ = start.traits;
  interface_count_ = start.interface.size();
  layer_.emplace(start.interface, start.traits);
  work_.emplace(start.motion.position);
  series_.emplace(settings_.out, "coupler");
  if (settings_.frame_interval > 0) {
    record_.emplace(settings_.out, start.interface);
    record_->write(0, start.motion, {});
  }
  Progress progress(settings_.end_time, "window");
  while (time_ < settings_.end_time) {
    advance();
    progress.update(time_, static_cast<long>(window_.number));
  }
}

void CoupledRun::advance() {
  using Clock = std::chrono::steady_clock;
  const double left = settings_.end_time - time_;
  const double dt = window_length(left, settings_.coupling.fluid_steps_per_window, time_step_limit_);
  window_ = {.number = window_.number + 1, .iteration = 0, .time = time_, .dt = dt};
  const auto start = Clock::now();
  const Exchange done = [&] {
    const auto scope = timers_.measure("turns of the participants");
    return scheme_->compute(window_);
  }();
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();

  const auto scope = timers_.measure("audit and record");
  time_step_limit_ = done.fluid.time_step_limit;
  time_ = dt == left ? settings_.end_time : time_ + dt;
  smallest_window_ = window_.number == 1 ? dt : std::min(smallest_window_, dt);
  largest_window_ = std::max(largest_window_, dt);
  note_convergence(done);
  note_times(done, elapsed);
  audit(done);
  audit_work(done);
  check_added_mass(done.fluid.load);
  if (series_due_.at(time_)) write_series(done);
  if (record_ && frame_due_.at(time_)) record_->write(time_, done.solid.motion, done.felt);
}

void CoupledRun::check_added_mass(const InterfaceLoad& load) {
  const auto ratio = layer_->mass_ratio(load);
  if (!ratio) return;
  lightest_layer_ = std::min(lightest_layer_, *ratio);
  const double least = least_mass_ratio(settings_.coupling.scheme, fluid_, window_.dt);
  if (*ratio >= least || warned_of_mass_) return;
  log::warn("window {}: {}", window_.number, too_light(*ratio, least));
  warned_of_mass_ = true;
}

void CoupledRun::audit(const Exchange& done) {
  const double error = audit_.compare(done.fluid.load, done.felt, done.solid.impulse_taken, window_.dt);
  row_.impulse_error = std::max(row_.impulse_error, error);
  if (error <= ExchangeAudit::tolerance || warned_) return;
  log::warn(
      "window {}: impulse given and taken differ by {:.3g} of the sum of the forces; the largest difference "
      "of "
      "the run is in the summary",
      window_.number, error);
  warned_ = true;
}

void CoupledRun::audit_work(const Exchange& done) {
  work_->note(done.given, done.followed, done.felt, done.solid.motion.position,
              done.solid.health.kinetic_energy);
  if (warned_of_work_ || !work_->feeds()) return;
  log::warn(
      "window {}, t = {:.6g} s: the exchange feeds the solid: it took {:.3g} J/m of work where the fluid "
      "gave "
      "{:.3g}; its motion is not to be trusted; take scheme = 'serial_implicit', shorter windows or more "
      "artificial viscosity of the solid, see cases/pushed_column/window_map.toml",
      window_.number, time_, work_->taken(), work_->given());
  warned_of_work_ = true;
}

void CoupledRun::note_times(const Exchange& done, double elapsed) {
  round_trips_.push_back(elapsed - done.compute);
  fluid_compute_ += done.fluid_compute;
  solid_compute_ += done.solid_compute;
  ++row_.windows;
  row_.round_trip += round_trips_.back();
  row_.fluid_compute += done.fluid_compute;
  row_.solid_compute += done.solid_compute;
}

void CoupledRun::note_convergence(const Exchange& done) {
  iterations_ += done.iterations;
  row_.iterations = std::max(row_.iterations, done.iterations);
  row_.residual = std::max(row_.residual, done.residual);
  unconverged_in_a_row_ = done.converged ? 0 : unconverged_in_a_row_ + 1;
  if (done.converged) return;
  if (unconverged_++ == 0)
    log::warn(
        "window {}: not converged after {} iterations, residual {:.3g}; the summary counts such windows",
        window_.number, done.iterations, done.residual);
  if (unconverged_in_a_row_ < settings_.coupling.implicit->unconverged_windows_to_stop) return;
  throw PhysicsFailure(fmt::format(
      "coupling: {} windows in a row have not converged in {} iterations each, the last at t = {:.6g} s with "
      "a "
      "residual of {:.3g} (tolerance {:.3g})",
      unconverged_in_a_row_, done.iterations, time_, done.residual, settings_.coupling.implicit->tolerance));
}

void CoupledRun::write_series(const Exchange& done) {
  const Vec force = sum_of(done.felt.force) + sum_of(done.felt.friction_force);
  const double windows = row_.windows;
  std::vector<Observation> row{{"dt", "s", window_.dt},
                               {"window", "1", static_cast<double>(window_.number)},
                               {"round_trip", "s", row_.round_trip / windows},
                               {"fluid_compute", "s", row_.fluid_compute / windows},
                               {"solid_compute", "s", row_.solid_compute / windows},
                               {"impulse_error", "1", row_.impulse_error},
                               {"work_given", "J/m", work_->given()},
                               {"work_taken", "J/m", work_->taken()},
                               {"interface_force_x", "N/m", force.x()},
                               {"interface_force_y", "N/m", force.y()},
                               {"fluid_kinetic_energy", "J/m", done.fluid.health.kinetic_energy},
                               {"fluid_potential_energy", "J/m", done.fluid.health.potential_energy},
                               {"solid_kinetic_energy", "J/m", done.solid.health.kinetic_energy},
                               {"solid_potential_energy", "J/m", done.solid.health.potential_energy}};
  if (settings_.coupling.windows_repeat()) {
    row.push_back({"iterations", "1", static_cast<double>(row_.iterations)});
    row.push_back({"residual", "1", row_.residual});
  }
  series_->write(time_, row);
  row_ = {};
}

void CoupledRun::report(Summary& summary) const {
  summary.simulated_time = time_;
  summary.waiting_time = timers_.seconds("turns of the participants");
  summary.steps = static_cast<long>(round_trips_.size());
  summary.smallest_time_step = smallest_window_;
  summary.largest_time_step = largest_window_;
  summary.time_step_rule = "fluid's limit";
  summary.parts = timers_.parts();
  summary.particles = {{"interface", static_cast<long>(interface_count_)}};
  if (round_trips_.empty()) return;
  auto sorted = round_trips_;
  std::sort(sorted.begin(), sorted.end());
  double total = 0;
  for (const double trip : sorted) total += trip;
  summary.figures = {{"largest_impulse_error", audit_.largest()},
                     {"round_trip_median", sorted[sorted.size() / 2]},
                     {"round_trip_99_percent", sorted[sorted.size() * 99 / 100]},
                     {"round_trip_total", total},
                     {"round_trip_share", total / summary.wall_time},
                     {"fluid_compute_total", fluid_compute_},
                     {"solid_compute_total", solid_compute_},
                     {"work_given", work_->given()},
                     {"work_taken", work_->taken()}};
  if (std::isfinite(lightest_layer_)) summary.figures.emplace_back("lightest_layer", lightest_layer_);
  if (!settings_.coupling.windows_repeat()) return;
  summary.figures.emplace_back("iterations", static_cast<double>(iterations_));
  summary.figures.emplace_back("unconverged_windows", static_cast<double>(unconverged_));
}

}  // namespace toryu::coupling
