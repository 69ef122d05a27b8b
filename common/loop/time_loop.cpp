#include "common/loop/time_loop.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "common/error/ending.hpp"
#include "common/error/failure.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/progress.hpp"
#include "common/run/team.hpp"

namespace toryu {

namespace {

/// A step that is a smaller share of its way never arrives: time would stand still.
constexpr double most_needed = 1e12;

/// What the limit may fall by within a window before the window is divided anew. The limits are shares of
/// what is stable that leave more than that.
constexpr double bearable_fall = 0.05;

SubSteps advance_within(Solver& solver, double length, double limit, long most) {
  if (!(limit * most_needed > length))  // NaN as well
    throw PhysicsFailure(fmt::format("time step of {:.3g} s ({} limit) is too small for {:.3g} s", limit,
                                     solver.time_step_rule(), length));
  const long needed = std::max(1L, static_cast<long>(std::ceil(length / limit * (1 - 1e-12))));
  const SubSteps steps{std::min(needed, most), needed, length / static_cast<double>(needed)};
  static Team team;  // that of this process
  for (long n = 0; n < steps.taken; ++n) team.compute([&] { solver.advance(steps.dt); });
  return steps;
}

}  // namespace

SubSteps advance_by(Solver& solver, double length, long most) {
  return advance_within(solver, length, solver.time_step_limit(), most);
}

int thread_count(const Options& options, std::size_t particles, int particles_per_thread) {
  if (options.threads > 0) return useful_threads(options.threads);
  return std::clamp(static_cast<int>(particles) / particles_per_thread, 1, omp_get_num_procs());
}

void advance_window(Solver& solver, RunRecord& record, double time, double length, long steps_between_checks,
                    const std::function<void(const SubSteps&)>& taken) {
  double planned = 0;
  for (double left = length; left > 1e-9 * length;) {
    throw_if_interrupted_again();  // the first time the coupler ends the run, with a checkpoint
    const double limit = solver.time_step_limit();
    const bool holds = limit < planned && limit > (1 - bearable_fall) * planned;
    const SubSteps steps = advance_within(solver, left, holds ? planned : limit, steps_between_checks);
    planned = steps.dt;
    left -= static_cast<double>(steps.taken) * steps.dt;
    record.count_steps(steps.taken, steps.dt);
    taken(steps);
    record.check(time + length - left);
  }
}

void check_start(const Solver& solver, const std::string& section) {
  try {
    solver.check(0);
  } catch (const PhysicsFailure& failure) {
    throw BadKey(section, std::string("cannot start: ") + failure.what());
  }
}

void run_alone(const Scene& scene, Solver& solver, RunRecord& record, long steps_between_checks,
               CheckpointsAlone& checkpoints) {
  double time = record.time();
  if (record.steps() > 0 && time >= scene.end_time) {
    log::warn("nothing to compute: the run is at t = {:g} s, and ends at {:g} s", time, scene.end_time);
    return;
  }
  Progress progress(scene.end_time, "step");
  if (record.steps() == 0) record.check_and_write(time);
  while (time < scene.end_time) {
    const double until = std::min(scene.end_time, record.next_output());
    const SubSteps steps = advance_by(solver, until - time, steps_between_checks);
    time = steps.taken == steps.needed ? until : time + static_cast<double>(steps.taken) * steps.dt;
    record.count_steps(steps.taken, steps.dt);
    record.check_and_write(time);
    progress.update(time, record.steps());
    checkpoints.after_step(record);
  }
  checkpoints.at_end(record);
}

void run_recorded(RunRecord& record, const std::function<void()>& body, const std::function<void()>& leave,
                  const std::function<double()>& waiting_time) {
  record.measure_waiting(waiting_time);
  try {
    body();
    record.write_end();
    record.complete();
  } catch (...) {
    if (leave) leave();
    const Ending ending = ending_of_exception();
    // What ended the run says more than what fails here, is thrown on, and is told then.
    const auto nevertheless = [&](const std::function<void()>& work) {
      try {
        work();
      } catch (const std::exception& failure) {
        if (failure.what() != ending.reason) log::error("{}", failure.what());
      }
    };
    nevertheless([&] { record.write_last(); });
    nevertheless([&] { record.finish(ending.code, ending.reason); });
    throw;
  }
  record.finish(ExitCode::done, "");
}

}  // namespace toryu
