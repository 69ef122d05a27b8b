#include "coupler/coupled_run.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace toryu {

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
  motion_ = start.motion;
  time_step_limit_ = start.time_step_limit;
  particles_ = start.interface.size();
  series_.emplace(settings_.out, "coupler");
  if (settings_.frame_interval > 0) {
    record_.emplace(settings_.out, start.interface);
    record_->write(0, motion_, {});
  }
  Progress progress(settings_.end_time, "window");
  while (time_ < settings_.end_time) {
    advance();
    progress.update(time_, static_cast<long>(window_.number));
  }
}

/// The load that the case lets the solid feel.
InterfaceLoad CoupledRun::felt(const InterfaceLoad& given) const {
  InterfaceLoad load = given;
  if (!settings_.coupling.feels("pressure_and_viscous")) std::fill(load.force.begin(), load.force.end(), 0.0);
  if (!settings_.coupling.feels("friction")) load.friction_force.clear();
  return load;
}

void CoupledRun::advance() {
  using Clock = std::chrono::steady_clock;
  const double left = settings_.end_time - time_;
  const double dt = window_length(left, settings_.coupling.fluid_steps_per_window, time_step_limit_);
  window_ = {.number = window_.number + 1, .iteration = 0, .time = time_, .dt = dt};
  const auto start = Clock::now();
  const auto fluid = [&] {
    const auto scope = timers_.measure("fluid's turn");
    return link_.ask_fluid(window_, motion_);
  }();
  const InterfaceLoad load = felt(fluid.load);
  const auto solid = [&] {
    const auto scope = timers_.measure("solid's turn");
    return link_.ask_solid(window_, load);
  }();
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();

  const auto scope = timers_.measure("audit and record");
  motion_ = solid.motion;
  time_step_limit_ = fluid.time_step_limit;
  time_ = dt == left ? settings_.end_time : time_ + dt;
  smallest_window_ = window_.number == 1 ? dt : std::min(smallest_window_, dt);
  largest_window_ = std::max(largest_window_, dt);

  const double error = audit_.compare(fluid.load, load, solid.impulse_taken, dt);
  if (!(error <= ExchangeAudit::tolerance) && !warned_) {
    spdlog::warn(
        "window {}: impulse given and taken differ by {:.3g} of the sum of the forces; the largest "
        "difference of the run is in the summary",
        window_.number, error);
    warned_ = true;
  }
  round_trips_.push_back(elapsed - fluid.health.compute_time - solid.health.compute_time);
  fluid_compute_ += fluid.health.compute_time;
  solid_compute_ += solid.health.compute_time;
  ++row_.windows;
  row_.round_trip += round_trips_.back();
  row_.fluid_compute += fluid.health.compute_time;
  row_.solid_compute += solid.health.compute_time;
  row_.impulse_error = std::max(row_.impulse_error, error);
  if (series_due_.at(time_)) write_series(load, fluid, solid);
  if (record_ && frame_due_.at(time_)) record_->write(time_, motion_, load);
}

void CoupledRun::write_series(const InterfaceLoad& load, const CouplerLink::FluidAnswer& fluid,
                              const CouplerLink::SolidAnswer& solid) {
  const Vec force = sum_of(load.force) + sum_of(load.friction_force);
  const double windows = row_.windows;
  series_->write(time_, {{"dt", "s", window_.dt},
                         {"window", "1", static_cast<double>(window_.number)},
                         {"round_trip", "s", row_.round_trip / windows},
                         {"fluid_compute", "s", row_.fluid_compute / windows},
                         {"solid_compute", "s", row_.solid_compute / windows},
                         {"impulse_error", "1", row_.impulse_error},
                         {"interface_force_x", "N/m", force.x()},
                         {"interface_force_y", "N/m", force.y()},
                         {"fluid_kinetic_energy", "J/m", fluid.health.kinetic_energy},
                         {"fluid_potential_energy", "J/m", fluid.health.potential_energy},
                         {"solid_kinetic_energy", "J/m", solid.health.kinetic_energy},
                         {"solid_potential_energy", "J/m", solid.health.potential_energy}});
  row_ = {};
}

void CoupledRun::report(Summary& summary) const {
  summary.simulated_time = time_;
  summary.waiting_time = timers_.seconds("fluid's turn") + timers_.seconds("solid's turn");
  summary.steps = static_cast<long>(round_trips_.size());
  summary.smallest_time_step = smallest_window_;
  summary.largest_time_step = largest_window_;
  summary.time_step_rule = "fluid's limit";
  summary.parts = timers_.parts();
  summary.particles = {{"interface", static_cast<long>(particles_)}};
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
                     {"solid_compute_total", solid_compute_}};
}

}  // namespace toryu
