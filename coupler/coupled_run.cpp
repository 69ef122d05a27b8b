#include "coupler/coupled_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ctime>

#include "common/error/failure.hpp"
#include "common/link/serialize.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"
#include "common/run/progress.hpp"
#include "common/state/serialize.hpp"

namespace toryu::coupling {

namespace {

constexpr const char* turns = "turns of the participants";

constexpr double least_share_of_run = 1e-12;  // of a window: 30 years at 1000 windows a second

}  // namespace

double window_length(double left, int steps, double limit) {
  const double longest = steps * limit;
  if (left <= longest) return left;
  return left < 2 * longest ? 0.5 * left : longest;
}

void CoupledRun::run(const CouplingStart& start, const Checkpoints& checkpoints) {
  checkpoints_ = checkpoints;
  checkpoints_due_ = {checkpoints.interval, checkpoints.every};
  scheme_ = make_scheme(settings_.coupling, port_, start);
  record_.emplace(settings_, start);
  if (checkpoints.restart) {
    read_state(checkpoints.restart->folder);
  } else {
    state_.time_step_limit = start.traits.time_step_limit;
    record_->begin(start.motion);
  }
  if (state_.time >= settings_.end_time) {
    log::warn("nothing to compute: the run is at t = {:g} s, and ends at {:g} s", state_.time,
              settings_.end_time);
    return;
  }
  Progress progress(settings_.end_time, "window");
  while (state_.time < settings_.end_time) {
    advance();
    progress.update(state_.time, static_cast<long>(state_.window.number));
    if (state_.time < settings_.end_time) stop_if_asked();
    if (checkpoints_due_.due(state_.time, wall_time())) write_checkpoint();
  }
  if (checkpoints_.wanted() && checkpoint_.empty()) write_checkpoint();
}

void CoupledRun::advance() {
  auto& [time, time_step_limit, window, wall, processor, waiting, parts] = state_;
  const double left = settings_.end_time - time;
  const double dt = window_length(left, settings_.coupling.fluid_steps_per_window, time_step_limit);
  if (dt < least_share_of_run * settings_.end_time && dt < left)
    throw PhysicsFailure(fmt::format(
        "time stands still: the fluid's time step limit is {:.3g} s at t = {:.6g} s", time_step_limit, time));
  window = {.number = window.number + 1, .iteration = 0, .time = time, .dt = dt};
  checkpoint_.clear();
  const auto start = Clock::now();
  {
    const auto scope = timers_.measure(turns);
    last_ = scheme_->compute(state_.window);
  }
  const Exchange& done = *last_;
  last_window_ = window;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();

  const auto scope = timers_.measure("audit and record");
  time_step_limit = done.fluid.time_step_limit;
  time = dt == left ? settings_.end_time : time + dt;
  record_->note(window, done, elapsed);
  record_->write(time, window, done);
}

void CoupledRun::complete() {
  write_last();
  if (record_) record_->complete();
}

void CoupledRun::write_last() {
  if (last_) record_->write_last(state_.time, last_window_, *last_);
}

void CoupledRun::stop_if_asked() {
  std::string reason;
  if (stop_.found())
    reason = fmt::format("ended by the file 'stop' in {}", settings_.out.string());
  else if (interruption_requested() || port_.interrupted())
    reason = "interrupted";
  else
    return;
  reason += fmt::format(" at t = {:g} s", state_.time);
  if (checkpoints_.wanted()) write_checkpoint();
  if (!checkpoint_.empty()) reason += fmt::format("; --restart goes on from {}", checkpoint_.string());
  throw Interrupted(reason);
}

/// Lets both participants write their parts; returns why one could not.
std::string CoupledRun::let_participants_write(const std::filesystem::path& folder) {
  try {
    const auto failures =
        port_.write_checkpoint(state_.window, std::filesystem::relative(folder, settings_.out).string());
    return fmt::format("{}", fmt::join(failures, "; "));
  } catch (...) {  // a participant is lost, and with it the run
    abandon_checkpoint(folder);
    throw;
  }
}

/// A checkpoint that cannot be written is told of, and the run goes on.
void CoupledRun::write_checkpoint() {
  const auto scope = timers_.measure("checkpoints");
  std::filesystem::path folder;
  std::string failure;
  const auto attempt = [&](const auto& step) {
    try {
      if (failure.empty()) step();
    } catch (const std::exception& reason) {
      failure = reason.what();
    }
  };
  attempt([&] { folder = opened_ = open_checkpoint(settings_.out, opened_); });
  if (failure.empty()) failure = let_participants_write(folder);
  attempt([&] {
    write_part(folder, "coupler", {"coupler"}, [&](std::ostream& stream) { write_state(stream); });
    complete_checkpoint(folder, state_.time, checkpoints_.case_text, {"fluid", "solid", "coupler"});
  });
  checkpoints_due_.note(state_.time, wall_time());
  if (failure.empty()) {
    checkpoint_ = folder;
    log::info("checkpoint at t = {:g} s in {}", state_.time, folder.string());
  } else {
    abandon_checkpoint(folder);
    log::warn("no checkpoint at t = {:g} s: {}", state_.time, failure);
  }
}

void CoupledRun::write_state(std::ostream& stream) {
  State now = state_;
  now.wall_time = wall_time();
  now.processor_time += static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  now.waiting_time = waiting_time();
  now.parts = sum_of(state_.parts, timers_.parts());
  write_states(stream, now);
  scheme_->write_state(stream);
  record_->write_state(stream);
}

void CoupledRun::read_state(const std::filesystem::path& folder) {
  read_part(folder, "coupler", {"coupler"}, [&](std::istream& stream) {
    read_states(stream, state_);
    scheme_->read_state(stream);
    record_->read_state(stream, state_.time);
  });
  checkpoint_ = folder;
  checkpoints_due_.note(state_.time, wall_time());
  log::info("goes on at t = {:g} s, after window {}, from {}", state_.time, state_.window.number,
            folder.string());
}

/// Since the start of the run, the time before a restart included [s].
double CoupledRun::wall_time() const {
  return state_.wall_time + std::chrono::duration<double>(Clock::now() - start_).count();
}

double CoupledRun::waiting_time() const {
  return state_.waiting_time + timers_.seconds(turns);
}

void CoupledRun::report(Summary& summary) const {
  summary.simulated_time = state_.time;
  summary.wall_time += state_.wall_time;
  summary.processor_time += state_.processor_time;
  summary.waiting_time = waiting_time();
  summary.time_step_rule = "fluid's limit";
  summary.parts = sum_of(state_.parts, timers_.parts());
  if (record_) record_->report(summary);
}

}  // namespace toryu::coupling
