/// The coupler: brings the fluid and the solid of a case together, gives each its turn, checks and records
/// what they exchange, and ends the run for all. README.md shows the sequence.
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "common/error/ending.hpp"
#include "common/link/coupler_link.hpp"
#include "common/link/identity.hpp"
#include "common/loop/series_columns.hpp"
#include "common/output/atomic_file.hpp"
#include "common/output/results.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/run/run_lock.hpp"
#include "common/run/standard_streams.hpp"
#include "common/scene/scene.hpp"
#include "common/state/checkpoint.hpp"
#include "coupler/coupled_run.hpp"
#include "coupler/stability_warnings.hpp"
#include "coupler/used_case.hpp"

namespace {

using namespace toryu;
using namespace toryu::coupling;

double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// There are no checkpoints where a participant cannot write any.
void drop_unless_all_can(Checkpoints& checkpoints, const CouplerLink::Partners& partners) {
  for (const auto* partner : {&partners.fluid, &partners.solid}) {
    if (partner->can_checkpoint || !checkpoints.wanted()) continue;
    log::warn("{} cannot write checkpoints: the run goes on without", partner->program);
    checkpoints.interval = checkpoints.every = 0;
  }
}

/// Joins both participants and runs all windows.
void run_windows(const CaseFile& file, const Settings& settings, Checkpoints checkpoints, CouplerLink& link,
                 CoupledRun& run) {
  const auto partners = link.gather(
      {.windows_repeat = settings.coupling.windows_repeat(), .restart = checkpoints.restart.has_value()});
  drop_unless_all_can(checkpoints, partners);
  checkpoints.case_text = merge_used_cases({file.used(), partners.fluid.used_case, partners.solid.used_case});
  CouplerLink::Beginning beginning{.checkpoints = checkpoints.wanted()};
  if (checkpoints.restart) {
    check_same_case(*checkpoints.restart, checkpoints.case_text);
    beginning.restart = std::filesystem::relative(checkpoints.restart->folder, settings.out).string();
  }
  write_atomically(settings.out / "used_case.toml", checkpoints.case_text);
  copy_named_files(file, settings.out);
  run.run(link.begin(beginning), checkpoints);
}

void run_and_sum_up(const CaseFile& file, const Settings& settings, const Checkpoints& checkpoints) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Summary summary;
  summary.participant = "coupler";
  summary.provenance = provenance(1);
  CouplerLink link({.role = "coupler",
                    .version = summary.provenance.version,
                    .out = settings.out,
                    .network = settings.network,
                    .case_hash = file.hash(),
                    .time_limit = settings.coupling.time_limit,
                    .used_case = file.used()});
  CoupledRun run(settings, link);
  const auto finish = [&](const Ending& ending) {
    summary.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
    summary.processor_time = processor_time();
    run.report(summary);
    summary.exit_code = ending.code;
    summary.end_reason = ending.reason;
    write_summary(settings.out, summary);
  };
  try {
    run_windows(file, settings, checkpoints, link, run);
    link.stop(ExitCode::done, "");
    run.complete();
  } catch (...) {
    const Ending ending = ending_of_exception();
    link.stop(ending.code, ending.reason);
    try {
      // where a run was to go on and could not, the summary of the run before stays
      if (run.has_begun() || !checkpoints.restart) finish(ending);
      run.write_last();
    } catch (const std::exception& failure) {
      log::error("{}", failure.what());  // what ended the run says more, and is thrown on
    }
    throw;
  }
  finish({});
  for (const auto& [name, value] : summary.figures) log::info("{} {:.4g}", name, value);
}

ExitCode couple(const Options& options) {
  CaseFile file(options.case_path, options.overrides);
  const Scene scene = read_scene(file);
  Parameters coupling;
  file.read("coupling", coupling, "how the fluid and the solid exchange their load and motion");
  file.ignore_sections({"fluid", "solid"});
  for (const char* section : {"fluid", "solid"})
    if (!file.has(section))
      file.fault("coupling", fmt::format("a coupled case needs a section [{}]", section));
  if (options.describe) {
    print(file.description());
    return ExitCode::done;
  }
  check_folder(file, options.out);
  const SeriesColumns series =
      series_columns("coupler", CoupledRecord::row_of(coupling, {}, {}, {}, WorkAudit({})));
  check_references(file, scene, series);
  file.throw_if_faulty();
  for (const auto& beyond : stability_warnings(file, coupling)) log::warn("{}", beyond);
  check_identity(options.network, "coupler");
  if (options.check) {
    if (options.columns) print(listed(series));
    return ExitCode::done;
  }

  const RunLock lock(options.out);
  claim_folder(options, "coupler");
  Checkpoints checkpoints{.interval = scene.checkpoint_interval, .every = scene.checkpoint_every};
  if (options.restart) checkpoints.restart = checkpoint_to_restart(options.out);
  run_and_sum_up(file,
                 {.end_time = scene.end_time,
                  .frame_interval = scene.frame_interval,
                  .series_interval = scene.series_interval,
                  .coupling = coupling,
                  .solid = solid_kind(file),
                  .out = options.out,
                  .network = options.network},
                 checkpoints);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("coupler", argc, argv, couple, CanCheckpoint::yes);
}
