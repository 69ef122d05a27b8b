/// The solid participant: computes the elastic body of a case, alone or in turn with a fluid.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "common/error/counted.hpp"
#include "common/link/participant.hpp"
#include "common/loop/outlook.hpp"
#include "common/loop/series_columns.hpp"
#include "common/loop/time_loop.hpp"
#include "common/output/atomic_file.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/run/run_lock.hpp"
#include "common/run/standard_streams.hpp"
#include "common/scene/bodies.hpp"
#include "solid_solver/detached_list.hpp"
#include "solid_solver/drive.hpp"
#include "solid_solver/make_model.hpp"
#include "solid_solver/periodic_space.hpp"
#include "solid_solver/stability_warnings.hpp"

namespace {

using namespace toryu;
using namespace toryu::solid;

/// So many steps are taken alone before the time-step limit and the state are looked at again.
constexpr long steps_between_checks = 50;

/// A thread more is worth its waiting for the others only with so many particles of its own.
constexpr int particles_per_thread = 4000;

RunRecord::Counts particle_counts(const SolidModel& model) {
  RunRecord::Counts counts{{"solid", static_cast<long>(model.particle_count())}};
  for (const auto& [name, count] : model.body().counts) counts.emplace_back(name, static_cast<long>(count));
  return counts;
}

/// Lists what comes off the solid, if the case asks for it, in the folder of results.
void list_detached(const Options& options, const Parameters& parameters, SolidModel& model) {
  if (!parameters.detachment) return;
  model.record_detached([list = DetachedList(options.out)](const auto& all) mutable { list.write(all); });
}

void compute_alone(const Options& options, const CaseFile& file, const Scene& scene,
                   const Parameters& parameters, SolidModel& model) {
  const RunLock lock(options.out);
  claim_folder(options, "solid");
  CheckpointsAlone checkpoints(options, scene, file.used());
  write_atomically(options.out / "used_case.toml", file.used());
  copy_named_files(file, options.out);
  RunRecord record("solid", options, scene, model, particle_counts(model), model.timers());
  list_detached(options, parameters, model);
  checkpoints.resume(record);
  run_recorded(record, [&] {
    run_alone(scene, model, record, scene.series_interval == 0 ? 1 : steps_between_checks, checkpoints);
  });
}

/// Joins the run with the particles that the fluid may touch; returns their numbers.
std::vector<std::uint32_t> join(SolidLink& link, const SolidModel& model) {
  const double reach = link.join();
  const Interface interface = model.interface(reach);
  log::info("{} can be touched by a fluid that sees {:g} m deep", counted(interface.size(), "particle"),
            reach);
  link.register_interface(interface, model.motion(interface.id));
  return interface.id;
}

/// Takes turns with the fluid until the coupler ends the run. In each window the load is constant, but
/// for its impedance, and the solid takes as many equal sub-steps as its stability needs.
void take_turns(SolidLink& link, SolidModel& model, RunRecord& record,
                const std::vector<std::uint32_t>& touched) {
  take_windows(link, model, record, [&](const SolidLink::Turn& turn) {
    const Vec force = model.set_interface_load(touched, turn.load);
    Vec impulse_taken = Vec::Zero();
    advance_window(model, record, turn.time, turn.dt, steps_between_checks, [&](const SubSteps& steps) {
      link.count_step();
      for (long n = 0; n < steps.taken; ++n) impulse_taken += steps.dt * force;
    });
    InterfaceMotion motion = model.motion(touched);
    motion.impulse = model.excess_impulse();
    motion.work_of_impulse = model.work_of_excess_impulse();
    for (std::size_t n = 0; n < touched.size() && !motion.impulse.empty(); ++n)
      impulse_taken += vector_of(motion.impulse, n);
    link.send(motion, impulse_taken, model.health());
  });
}

void compute_coupled(const Options& options, const CaseFile& file, const Scene& scene,
                     const Parameters& parameters, SolidModel& model) {
  SolidLink link({.role = "solid_solver",
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_repeat = true,
                  .can_checkpoint = true,
                  .used_case = file.used()});
  std::vector<std::uint32_t> touched;
  try {
    touched = join(link, model);
  } catch (...) {
    link.leave();
    throw;
  }
  const double joined = link.waiting_time();  // the record's time begins now
  // Only now: a solid that the coupler refuses must leave alone what another is writing in the folder.
  RunRecord record("solid", options, scene, model, particle_counts(model), model.timers());
  list_detached(options, parameters, model);
  run_recorded(
      record, [&] { take_turns(link, model, record, touched); }, [&] { link.leave(); },
      [&] { return link.waiting_time() - joined; });
}

ExitCode solve(const Options& options) {
  CaseFile file(options.case_path, options.overrides);
  const Scene scene = read_scene(file);
  Parameters parameters;
  file.read("solid", parameters, "an elastic body in plane strain, or a rigid one");
  file.ignore_sections({"fluid", "coupling"});
  if (options.describe) {
    print(file.description());
    return ExitCode::done;
  }
  check_folder(file, options.out);
  file.throw_if_faulty();
  take_motions(file, scene, parameters);
  for (const auto& [key, message] : periodic_faults(parameters, scene)) file.fault(key, message);
  file.throw_if_faulty();
  const Period period(scene);
  repeat_holes(period, parameters);
  const Body body = build_body(
      parameters, [&](const std::string& key, const std::string& message) { file.fault(key, message); },
      period.shifts());
  file.throw_if_faulty();
  omp_set_num_threads(thread_count(options, body.size(), particles_per_thread));
  const auto model = make_model(parameters, body, scene);
  check_start(*model, "[solid]");
  check_columns(model->observe(), "[solid]");
  const SeriesColumns series = series_columns("solid", model->observe());
  check_references(file, scene, series);
  file.throw_if_faulty();
  for (const auto& beyond : stability_warnings(parameters)) log::warn("{}", beyond);
  for (const auto& passage : passage_warnings(file, scene)) log::warn("{}", passage);
  if (!file.has("fluid"))  // whose program tells of them
    for (const auto& unknown : unknown_meetings(file, scene)) log::warn("{}", unknown);
  if (options.check) {
    write_start(options.start_frames, "solid", *model);
    if (!file.has("fluid"))  // whose program tells them
      for (const auto& line : motion_lines(file, scene)) print("[case]: " + line + '\n');
    if (parameters.formulation == Formulation::rigid)  // whose mass and frequencies are known beforehand
      for (const auto& term : model->active_terms())
        print(fmt::format("[solid]: {}: {}\n", term.name, term.parameters));
    if (options.columns) {
      print(listed(series));
      if (parameters.detachment) print(listed(DetachedList::columns()));
    }
    if (options.outlook) print(outlook("[solid]", *model, scene.end_time).text);
    return ExitCode::done;
  }
  if (body.has_outline())
    log::info("particles fit the outline; their density is even within {:.2g} %", 100 * body.spread);
  log::info("area {:.6g} m2, mass {:.6g} kg per metre of depth", body.total_volume(), model->total_mass());
  if (!file.has("fluid")) {
    compute_alone(options, file, scene, parameters, *model);
    return ExitCode::done;
  }
  compute_coupled(options, file, scene, parameters, *model);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return toryu::run_program("solid_solver", argc, argv, solve, toryu::CanCheckpoint::yes);
}
