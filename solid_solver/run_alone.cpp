#include "solid_solver/run_alone.hpp"

#include <algorithm>

#include "common/run/program.hpp"
#include "common/run/progress.hpp"

namespace toryu {

namespace {

/// So many sub-steps are taken before the time-step limit and the state are looked at again.
constexpr long sub_steps_between_checks = 50;

}  // namespace

void run_alone(const Scene& scene, SolidRun& run) {
  Progress progress(scene.end_time, "step");
  double time = 0;
  run.at(time);
  while (time < scene.end_time) {
    throw_if_interrupted();
    const double until = std::min(scene.end_time, run.next_output());
    const SubSteps steps = run.advance(until - time, run.writes_every_step() ? 1 : sub_steps_between_checks);
    time = steps.taken == steps.needed ? until : time + static_cast<double>(steps.taken) * steps.dt;
    run.at(time);
    progress.update(time, run.steps());
  }
}

}  // namespace toryu
