#include "common/loop/run_record.hpp"

#include <omp.h>

#include <cmath>
#include <ctime>

#include "common/error/counted.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/provenance.hpp"
#include "common/state/serialize.hpp"

namespace toryu {

namespace {

double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

RunRecord::RunRecord(const std::string& participant, const Options& options, const Scene& scene,
                     Solver& solver, const Counts& counts, const Timers& timers)
    : participant_(participant),
      author_{participant + "_solver"},
      solver_(solver),
      solver_timers_(timers),
      out_(options.out),
      frames_(options.out, participant, provenance(omp_get_max_threads())),
      series_(options.out, participant),
      frames_due_(scene.frame_interval),
      series_due_(scene.series_interval),
      every_step_(scene.series_interval == 0),
      to_be_resumed_(options.restart) {
  if (solver.walls()) walls_.emplace(options.out, "walls", provenance(omp_get_max_threads()));
  summary_.participant = participant;
  summary_.provenance = provenance(omp_get_max_threads());
  summary_.time_step_rule = solver.time_step_rule();
  summary_.particles = counts;
  for (const auto& [name, count] : counts) log::info("{} has {}", name, counted(count, "particle"));
  summary_.terms = solver.active_terms();
  for (const auto& term : summary_.terms)
    log::info("term {}: {}; {} [{}]", term.name, term.formula, term.parameters, term.source);
  log::info("largest time step {:.4g} s ({} limit)", solver.time_step_limit(), solver.time_step_rule());
}

void RunRecord::check(double time) {
  const auto scope = timers_.measure("check");
  reached_ = time;
  solver_.check(time);
}

void RunRecord::write(double time) {
  solver_.accept();
  state_.time = time;
  const bool row = series_due_.reached(time) || every_step_;
  if (row) write_row(time);
  if (frames_due_.reached(time)) write_frame(time);
  if (row) solver_.watch(time);
}

void RunRecord::write_last() {
  if (to_be_resumed_ || !reached_) return;
  if (row_written_ != reached_) write_row(*reached_);
  if (frames_due_.state().interval > 0 && frame_written_ != reached_) write_frame(*reached_);
}

void RunRecord::write_end() {
  const auto before = row_written_;
  write_last();
  if (row_written_ != before) solver_.watch(*reached_);
}

void RunRecord::write_row(double time) {
  const auto scope = timers_.measure("series");
  solver_.record(time);
  series_.write(time, solver_.observe());
  row_written_ = time;
}

void RunRecord::write_frame(double time) {
  const auto scope = timers_.measure("frames");
  frames_.write(time, solver_.frame());
  if (walls_ && (walls_->count() == 0 || solver_.walls_move())) walls_->write(time, *solver_.walls());
  frame_written_ = time;
}

void RunRecord::count_steps(long steps, double dt) {
  state_.steps += steps;
  state_.smallest_time_step = std::min(state_.smallest_time_step, dt);
  state_.largest_time_step = std::max(state_.largest_time_step, dt);
}

void RunRecord::complete() {
  frames_.complete();
  if (walls_) walls_->complete();
  series_.complete();
  solver_.complete_records();
}

void RunRecord::finish(ExitCode code, const std::string& end_reason) {
  if (to_be_resumed_) return;
  summary_.exit_code = code;
  summary_.end_reason = end_reason;
  summary_.simulated_time = state_.time;
  summary_.steps = state_.steps;
  summary_.smallest_time_step = state_.steps > 0 ? state_.smallest_time_step : 0;
  summary_.largest_time_step = state_.largest_time_step;
  summary_.waiting_time = waiting_time();
  summary_.wall_time = wall_time();
  summary_.processor_time = state_.processor_time + processor_time();
  summary_.time_step_rule = solver_.time_step_rule();
  summary_.figures = solver_.figures();
  summary_.parts = parts();
  write_summary(out_, summary_);
  log::info("{} to t = {:g} s in {:.2f} s", counted(summary_.steps, "step"), summary_.simulated_time,
            summary_.wall_time);
}

/// Where the time went, before a restart too.
std::vector<Timers::Part> RunRecord::parts() const {
  auto now = solver_timers_.parts();
  now.insert(now.end(), timers_.parts().begin(), timers_.parts().end());
  return sum_of(state_.parts, now);
}

double RunRecord::wall_time() const {
  return state_.wall_time + std::chrono::duration<double>(Clock::now() - start_).count();
}

void RunRecord::write_checkpoint(const std::filesystem::path& folder) {
  const auto scope = timers_.measure("checkpoints");
  State now = state_;
  now.wall_time = wall_time();
  now.processor_time += processor_time();
  now.waiting_time = waiting_time();
  now.parts = parts();
  now.frames_due = frames_due_.state();
  now.series_due = series_due_.state();
  now.series = series_.state();
  now.frames = frames_.state();
  if (walls_) now.walls = walls_->state();
  write_part(folder, participant_, author_, [&](std::ostream& stream) {
    write_states(stream, now);
    solver_.write_state(stream);
  });
}

void RunRecord::read_checkpoint(const std::filesystem::path& folder) {
  read_part(folder, participant_, author_, [&](std::istream& stream) {
    read_states(stream, state_);
    solver_.read_state(stream);
  });
  to_be_resumed_ = false;
  frames_due_.resume(state_.frames_due, state_.time);
  series_due_.resume(state_.series_due, state_.time);
  frames_.resume(state_.frames);
  if (walls_) walls_->resume(state_.walls);
  series_.resume(state_.series);
  log::info("goes on at t = {:g} s from {}", state_.time, folder.string());
}

void write_start(const std::filesystem::path& folder, const std::string& participant, const Solver& solver) {
  if (folder.empty()) return;
  FrameWriter frames(folder, participant, provenance(1));
  frames.write(0, solver.frame());
  frames.complete();
  const auto walls = solver.walls();
  if (!walls) return;
  FrameWriter beside(folder, "walls", provenance(1));
  beside.write(0, *walls);
  beside.complete();
}

}  // namespace toryu
