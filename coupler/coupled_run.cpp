#include "coupler/coupled_run.hpp"

#include "common/run/progress.hpp"

namespace toryu::coupling {

double window_length(double left, int steps, double limit) {
  const double longest = steps * limit;
  if (left <= longest) return left;
  return left < 2 * longest ? 0.5 * left : longest;
}

void CoupledRun::run(const CouplingStart& start) {
  scheme_ = make_scheme(settings_.coupling, port_, start);
  record_.emplace(settings_, start);
  state_.time_step_limit = start.traits.time_step_limit;
  Progress progress(settings_.end_time, "window");
  while (state_.time < settings_.end_time) {
    advance();
    progress.update(state_.time, static_cast<long>(state_.window.number));
  }
}

void CoupledRun::advance() {
  using Clock = std::chrono::steady_clock;
  auto& [time, time_step_limit, window] = state_;
  const double left = settings_.end_time - time;
  const double dt = window_length(left, settings_.coupling.fluid_steps_per_window, time_step_limit);
  window = {.number = window.number + 1, .iteration = 0, .time = time, .dt = dt};
  const auto start = Clock::now();
  const Exchange done = [&] {
    const auto scope = timers_.measure("turns of the participants");
    return scheme_->compute(window);
  }();
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();

  const auto scope = timers_.measure("audit and record");
  time_step_limit = done.fluid.time_step_limit;
  time = dt == left ? settings_.end_time : time + dt;
  record_->note(window, done, elapsed);
  record_->write(time, window, done);
}

void CoupledRun::report(Summary& summary) const {
  summary.simulated_time = state_.time;
  summary.waiting_time = timers_.seconds("turns of the participants");
  summary.time_step_rule = "fluid's limit";
  summary.parts = timers_.parts();
  if (record_) record_->report(summary);
}

}  // namespace toryu::coupling
