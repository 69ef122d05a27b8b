#include "solid_solver/solid_run.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace toryu {

bool Schedule::reached(double time) {
  if (time < next() - 1e-9 * interval_) return false;
  count_ = static_cast<long>(std::floor(time / interval_ + 1e-9)) + 1;
  return true;
}

SolidRun::SolidRun(const Options& options, const Scene& scene, SolidModel& model)
    : model_(model),
      out_(options.out),
      frames_(options.out, "solid", provenance(omp_get_max_threads())),
      series_(options.out, "solid"),
      frames_due_(scene.frame_interval),
      series_due_(scene.series_interval),
      every_step_(scene.series_interval == 0) {
  summary_.participant = "solid";
  summary_.provenance = provenance(omp_get_max_threads());
  summary_.time_step_rule = model.time_step_rule();
  summary_.smallest_time_step = std::numeric_limits<double>::infinity();
  summary_.particles.emplace_back("solid", static_cast<long>(model.particle_count()));
  for (const auto& [name, count] : model.body().counts) {
    summary_.particles.emplace_back(name, static_cast<long>(count));
    spdlog::info("solid: {} has {} particles", name, count);
  }
  spdlog::info("solid: {} particles of spacing {:g} m, area {:.6g} m2, mass {:.6g} kg/m",
               model.particle_count(), model.body().spacing, model.body().total_volume(), model.total_mass());
  summary_.terms = model.active_terms();
  for (const auto& term : summary_.terms)
    spdlog::info("solid: term {}: {}; {} [{}]", term.name, term.formula, term.parameters, term.source);
  spdlog::info("solid: largest time step {:.4g} s ({} limit)", model.time_step_limit(),
               model.time_step_rule());
}

void SolidRun::at(double time) {
  model_.check(time);
  summary_.simulated_time = time;
  if (series_due_.reached(time) || every_step_) {
    const auto scope = timers_.measure("series");
    series_.write(time, model_.observe());
  }
  if (frames_due_.reached(time)) {
    const auto scope = timers_.measure("frames");
    frames_.write(time, model_.frame());
  }
}

SubSteps SolidRun::advance(double length, long most) {
  const auto scope = timers_.measure("sub-steps");
  const double limit = model_.time_step_limit();
  const long needed = std::max(1L, static_cast<long>(std::ceil(length / limit * (1 - 1e-12))));
  const SubSteps steps{std::min(needed, most), needed, length / static_cast<double>(needed)};
  for (long n = 0; n < steps.taken; ++n) model_.advance(steps.dt);
  summary_.steps += steps.taken;
  summary_.smallest_time_step = std::min(summary_.smallest_time_step, steps.dt);
  summary_.largest_time_step = std::max(summary_.largest_time_step, steps.dt);
  return steps;
}

void SolidRun::finish(ExitCode code, const std::string& last_words, double waiting_time) {
  summary_.exit_code = code;
  summary_.last_words = last_words;
  summary_.waiting_time = waiting_time;
  summary_.wall_time = std::chrono::duration<double>(Clock::now() - start_).count();
  summary_.processor_time = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  if (summary_.steps == 0) summary_.smallest_time_step = 0;
  summary_.parts = timers_.parts();
  write_summary(out_, summary_);
  spdlog::info("solid: {} steps to t = {:g} s in {:.2f} s", summary_.steps, summary_.simulated_time,
               summary_.wall_time);
}

}  // namespace toryu
