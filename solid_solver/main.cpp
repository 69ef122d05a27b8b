/// The solid participant: computes the elastic body of a case, alone or in turn with a fluid.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "common/error/counted.hpp"
#include "common/link/identity.hpp"
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

/// A case and the solid that is made of it.
struct Setting {
  const Options& options;
  const CaseFile& file;
  const Scene& scene;
  const Parameters& parameters;
  RunRecord::Counts counts;  ///< particles by region and clamp
  Solid& solid;

  RunRecord record() const { return {"solid", options, scene, solid, counts, solid.timers()}; }
};

RunRecord::Counts particle_counts(const std::vector<Part>& parts) {
  RunRecord::Counts counts{{"solid", 0}};
  for (const Part& part : parts) {
    counts[0].second += static_cast<long>(part.body.size());
    for (const auto& [name, count] : part.body.counts) counts.emplace_back(name, static_cast<long>(count));
  }
  return counts;
}

/// Lists what comes off the solid, if the case asks for it, in the folder of results.
void list_detached(const Setting& run) {
  if (!run.parameters.detachment) return;
  run.solid.record_detached(
      [list = DetachedList(run.options.out)](const auto& all) mutable { list.write(all); });
}

void compute_alone(const Setting& run) {
  const Options& options = run.options;
  const RunLock lock(options.out);
  claim_folder(options, "solid");
  CheckpointsAlone checkpoints(options, run.scene, run.file.used());
  write_atomically(options.out / "used_case.toml", run.file.used());
  copy_named_files(run.file, options.out);
  RunRecord record = run.record();
  list_detached(run);
  checkpoints.resume(record);
  run_recorded(record, [&] {
    run_alone(run.scene, run.solid, record, run.scene.series_interval == 0 ? 1 : steps_between_checks,
              checkpoints);
  });
}

/// Joins the run with the particles that the fluid may touch; returns their numbers.
std::vector<std::uint32_t> join(SolidLink& link, const Solid& solid) {
  const double reach = link.join();
  const Interface interface = solid.interface(reach);
  log::info("{} can be touched by a fluid that sees {:g} m deep", counted(interface.size(), "particle"),
            reach);
  link.register_interface(interface, solid.motion(interface.id));
  return interface.id;
}

/// Takes turns with the fluid until the coupler ends the run. In each window the load is constant, but
/// for its impedance, and the solid takes as many equal sub-steps as its stability needs.
void take_turns(SolidLink& link, Solid& solid, RunRecord& record, const std::vector<std::uint32_t>& touched) {
  take_windows(link, solid, record, [&](const SolidLink::Turn& turn) {
    const Vec force = solid.set_interface_load(touched, turn.load);
    Vec impulse_taken = Vec::Zero();
    advance_window(solid, record, turn.time, turn.dt, steps_between_checks, [&](const SubSteps& steps) {
      link.count_step();
      for (long n = 0; n < steps.taken; ++n) impulse_taken += steps.dt * force;
    });
    InterfaceMotion motion = solid.motion(touched);
    motion.impulse = solid.excess_impulse();
    motion.work_of_impulse = solid.work_of_excess_impulse();
    for (std::size_t n = 0; n < touched.size() && !motion.impulse.empty(); ++n)
      impulse_taken += vector_of(motion.impulse, n);
    link.send(motion, impulse_taken, solid.health());
  });
}

void compute_coupled(const Setting& run) {
  SolidLink link({.role = "solid_solver",
                  .version = provenance(1).version,
                  .out = run.options.out,
                  .network = run.options.network,
                  .case_hash = run.file.hash(),
                  .can_repeat = true,
                  .can_checkpoint = true,
                  .used_case = run.file.used()});
  std::vector<std::uint32_t> touched;
  try {
    touched = join(link, run.solid);
  } catch (...) {
    link.leave();
    throw;
  }
  const double joined = link.waiting_time();  // the record's time begins now
  // Only now: a solid that the coupler refuses must leave alone what another is writing in the folder.
  RunRecord record = run.record();
  list_detached(run);
  run_recorded(
      record, [&] { take_turns(link, run.solid, record, touched); }, [&] { link.leave(); },
      [&] { return link.waiting_time() - joined; });
}

/// What --check knows before a step is made.
void tell_start(const Setting& run, const SeriesColumns& series) {
  write_start(run.options.start_frames, "solid", run.solid);
  if (!run.file.has("fluid"))  // whose program tells them
    for (const auto& line : motion_lines(run.file, run.scene)) print("[case]: " + line + '\n');
  if (run.parameters.has_rigid_bodies())  // whose masses and frequencies are known beforehand
    for (const auto& term : run.solid.active_terms())
      print(fmt::format("[solid]: {}: {}\n", term.name, term.parameters));
  if (run.options.columns) {
    print(listed(series));
    if (run.parameters.detachment) print(listed(DetachedList::columns()));
  }
  if (run.options.outlook) print(outlook("[solid]", run.solid, run.scene.end_time).text);
}

void tell_bodies(const std::vector<Part>& parts) {
  double area = 0, mass = 0;
  for (const auto& [parameters, body] : parts) {
    area += body.total_volume();
    mass += body.total_mass();
    if (body.has_outline())
      log::info("particles fit the outline; their density is even within {:.2g} %", 100 * body.spread);
  }
  log::info("area {:.6g} m2, mass {:.6g} kg per metre of depth", area, mass);
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
  const std::vector<Part> parts = file.placed("solid", [&] {
    return build_parts(
        parameters, [&](const std::string& key, const std::string& message) { file.fault(key, message); },
        period.shifts());
  });
  file.throw_if_faulty();
  RunRecord::Counts counts = particle_counts(parts);
  omp_set_num_threads(
      thread_count(options, static_cast<std::size_t>(counts[0].second), particles_per_thread));
  const auto solid = file.placed("solid", [&] { return make_solid(parts, scene); });
  file.placed("solid", [&] { check_start(*solid, "solid"); });
  check_columns(file, solid->observe(), "solid");
  file.throw_if_faulty();
  const SeriesColumns series = series_columns("solid", solid->observe());
  check_references(file, scene, series);
  file.throw_if_faulty();
  for (const Part& part : parts)
    for (const auto& beyond : stability_warnings(part.parameters)) log::warn("{}", beyond);
  for (const auto& passage : passage_warnings(file, scene)) log::warn("{}", passage);
  if (!file.has("fluid"))  // whose program tells of them
    for (const auto& unknown : unknown_meetings(file, scene)) log::warn("{}", unknown);
  check_secured(options, file.has("fluid"), "solid");
  const Setting run{options, file, scene, parameters, std::move(counts), *solid};
  if (options.check) {
    tell_start(run, series);
    return ExitCode::done;
  }
  tell_bodies(parts);
  if (file.has("fluid"))
    compute_coupled(run);
  else
    compute_alone(run);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return toryu::run_program("solid_solver", argc, argv, solve, toryu::CanCheckpoint::yes);
}
