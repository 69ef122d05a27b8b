#include "common/loop/run_record.hpp"

#include <omp.h>

#include <cmath>
#include <ctime>

#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/provenance.hpp"

namespace toryu {

bool Schedule::reached(double time) {
  if (time < next() - 1e-9 * interval_) return false;
  count_ = static_cast<long>(std::floor(time / interval_ + 1e-9)) + 1;
  return true;
}

RunRecord::RunRecord(const std::string& participant, const Options& options, const Scene& scene,
                     Solver& solver, const Counts& counts, const Timers& timers)
    : solver_(solver),
      solver_timers_(timers),
      out_(options.out),
      frames_(options.out, participant, provenance(omp_get_max_threads())),
      series_(options.out, participant),
      frames_due_(scene.frame_interval),
      series_due_(scene.series_interval),
      every_step_(scene.series_interval == 0) {
  summary_.participant = participant;
  summary_.provenance = provenance(omp_get_max_threads());
  summary_.time_step_rule = solver.time_step_rule();
  summary_.smallest_time_step = std::numeric_limits<double>::infinity();
  summary_.particles = counts;
  for (const auto& [name, count] : counts) log::info("{} has {} particles", name, count);
  summary_.terms = solver.active_terms();
  for (const auto& term : summary_.terms)
    log::info("term {}: {}; {} [{}]", term.name, term.formula, term.parameters, term.source);
  log::info("largest time step {:.4g} s ({} limit)", solver.time_step_limit(), solver.time_step_rule());
}

void RunRecord::check(double time) {
  const auto scope = timers_.measure("check");
  solver_.check(time);
}

void RunRecord::write(double time) {
  solver_.accept();
  summary_.simulated_time = time;
  if (series_due_.reached(time) || every_step_) {
    const auto scope = timers_.measure("series");
    series_.write(time, solver_.observe());
    solver_.record(time);
  }
  if (frames_due_.reached(time)) {
    const auto scope = timers_.measure("frames");
    frames_.write(time, solver_.frame());
  }
}

void RunRecord::count_steps(long steps, double dt) {
  summary_.steps += steps;
  summary_.smallest_time_step = std::min(summary_.smallest_time_step, dt);
  summary_.largest_time_step = std::max(summary_.largest_time_step, dt);
}

void RunRecord::finish(ExitCode code, const std::string& last_words, double waiting_time) {
  summary_.exit_code = code;
  summary_.last_words = last_words;
  summary_.waiting_time = waiting_time;
  summary_.wall_time = std::chrono::duration<double>(Clock::now() - start_).count();
  summary_.processor_time = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  summary_.time_step_rule = solver_.time_step_rule();
  if (summary_.steps == 0) summary_.smallest_time_step = 0;
  summary_.figures = solver_.figures();
  summary_.parts = solver_timers_.parts();
  for (const auto& part : timers_.parts()) summary_.parts.push_back(part);
  write_summary(out_, summary_);
  log::info("{} steps to t = {:g} s in {:.2f} s", summary_.steps, summary_.simulated_time,
            summary_.wall_time);
}

}  // namespace toryu
