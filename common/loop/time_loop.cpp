#include "common/loop/time_loop.hpp"

#include <cmath>

#include "common/run/ending.hpp"
#include "common/run/program.hpp"
#include "common/run/progress.hpp"

namespace toryu {

SubSteps advance_by(Solver& solver, double length, long most) {
  const long needed =
      std::max(1L, static_cast<long>(std::ceil(length / solver.time_step_limit() * (1 - 1e-12))));
  const SubSteps steps{std::min(needed, most), needed, length / static_cast<double>(needed)};
  for (long n = 0; n < steps.taken; ++n) solver.advance(steps.dt);
  return steps;
}

void run_alone(const Scene& scene, Solver& solver, RunRecord& record, long steps_between_checks) {
  Progress progress(scene.end_time, "step");
  double time = 0;
  record.at(time);
  while (time < scene.end_time) {
    throw_if_interrupted();
    const double until = std::min(scene.end_time, record.next_output());
    const SubSteps steps = advance_by(solver, until - time, steps_between_checks);
    time = steps.taken == steps.needed ? until : time + static_cast<double>(steps.taken) * steps.dt;
    record.count_steps(steps.taken, steps.dt);
    record.at(time);
    progress.update(time, record.steps());
  }
}

void run_recorded(RunRecord& record, const std::function<void()>& body, const std::function<void()>& leave,
                  const std::function<double()>& waiting_time) {
  const auto waited = [&] { return waiting_time ? waiting_time() : 0.0; };
  try {
    body();
  } catch (...) {
    if (leave) leave();
    const Ending ending = ending_of_exception();
    record.finish(ending.code, ending.reason, waited());
    throw;
  }
  record.finish(ExitCode::done, "", waited());
}

}  // namespace toryu
