/// The fluid participant: computes the fluid of a case, alone or in turn with a solid.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <limits>

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
#include "common/scene/case_bodies.hpp"
#include "common/sph/skin.hpp"
#include "fluid_solver/axisymmetry.hpp"
#include "fluid_solver/flow_numbers.hpp"
#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/implicit/implicit_faults.hpp"
#include "fluid_solver/implicit/implicit_twin.hpp"
#include "fluid_solver/open_ends/section.hpp"
#include "fluid_solver/processes.hpp"
#include "fluid_solver/stability_warnings.hpp"
#include "fluid_solver/start_checks.hpp"
#include "fluid_solver/wall_rows.hpp"
#include "fluid_solver/worn_walls.hpp"

namespace {

using namespace toryu;
using fluid::FluidModel;

/// A thread more is worth its waiting for the others only with so many particles of its own.
constexpr int particles_per_thread = 1000;

RunRecord::Counts particle_counts(const FluidModel& model) {
  RunRecord::Counts counts{{"fluid", static_cast<long>(model.particle_count())}};
  for (const auto& boundary : model.boundaries())
    counts.emplace_back(boundary.name, static_cast<long>(boundary.count));
  return counts;
}

void compute_alone(const Options& options, const CaseFile& file, const Scene& scene, FluidModel& model) {
  const RunLock lock(options.out);
  claim_folder(options, "fluid");
  CheckpointsAlone checkpoints(options, scene, file.used());
  write_atomically(options.out / "used_case.toml", file.used());
  copy_named_files(file, options.out);
  RunRecord record("fluid", options, scene, model, particle_counts(model), model.timers());
  checkpoints.resume(record);
  run_recorded(record, [&] { run_alone(scene, model, record, 1, checkpoints); });
}

/// Takes turns with the solid until the coupler ends the run.
void take_turns(FluidLink& link, FluidModel& model, RunRecord& record) {
  take_windows(link, model, record, [&](const FluidLink::Turn& turn) {
    model.begin_window(turn.motion, turn.dt);
    advance_window(model, record, turn.time, turn.dt, 1, [&](const SubSteps&) { link.count_step(); });
    const InterfaceLoad load = model.take_load();
    link.send(load, model.time_step_limit(),
              {.kinetic_energy = model.kinetic_energy(),
               .potential_energy = model.potential_energy(),
               .momentum = model.momentum()});
  });
}

void warn_of_thin_wall(const fluid::Boundary& wall, double spacing, const fluid::Parameters& parameters,
                       const Scene& scene) {
  if (const auto thin = fluid::beyond_thinnest(wall, spacing, parameters, Period(scene).shifts()))
    log::warn("{}", *thin);
}

void warn_of_coarse_work_piece(double spacing, const fluid::Parameters& parameters) {
  if (const auto coarse = fluid::beyond_coarsest_work_piece(spacing, parameters)) log::warn("{}", *coarse);
}

void compute_coupled(const Options& options, const CaseFile& file, const Scene& scene,
                     const fluid::Parameters& parameters, FluidModel& model) {
  FluidLink link({.role = "fluid_solver",
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_repeat = true,
                  .can_checkpoint = true,
                  .used_case = file.used()});
  try {
    const Interface interface = link.join(model.traits());
    log::info("the solid's interface has {} of spacing {:g} m", counted(interface.size(), "particle"),
              interface.spacing);
    model.attach(interface, file.value<std::string>("solid.formulation") == "rigid");
    warn_of_thin_wall(model.boundaries().back(), interface.spacing, parameters, scene);
    warn_of_coarse_work_piece(interface.spacing, parameters);
  } catch (...) {
    link.leave();
    throw;
  }
  const double joined = link.waiting_time();  // the record's time begins now
  model.record_surface(options.out);          // anew, with the faces of the solid
  RunRecord record("fluid", options, scene, model, particle_counts(model), model.timers());
  run_recorded(
      record, [&] { take_turns(link, model, record); }, [&] { link.leave(); },
      [&] { return link.waiting_time() - joined; });
}

/// What --check knows of the flow before a step is made.
void tell_flow(const fluid::Parameters& parameters, const Scene& scene) {
  if (!parameters.similarity)  // which tells them of its passage
    if (const auto numbers = fluid::flow_numbers(parameters, scene))
      print("[fluid]: " + fluid::text(*numbers) + '\n');
  if (const auto creeps = fluid::creeping(parameters, scene)) print("[fluid]: " + *creeps + '\n');
}

/// Of the case as it is and, where it could be computed by implicit steps as well, which is cheaper.
void tell_outlook(FluidModel& model, double end_time, const std::optional<fluid::Parameters>& twin,
                  const Scene& scene_of_twin) {
  const Outlook own = outlook("[fluid]", model, end_time);
  print(own.text);
  if (!twin) return;
  const Outlook other =
      outlook("[fluid] by implicit steps", *fluid::make_model(*twin, scene_of_twin), end_time);
  print(other.text);
  if (own.time && other.time)
    print(*other.time < *own.time
              ? "[fluid]: implicit steps are cheaper: " + fluid::keys_of_twin(*twin) + '\n'
              : std::string("[fluid]: the case as it is is cheaper\n"));
}

/// Adds a fault of `file` for each section that others of the case make pointless or wrong.
void check_sections(CaseFile& file, const Scene& scene, const fluid::Parameters& parameters) {
  const auto is_work_piece = [](const Wall& wall) { return wall.work_piece; };
  const bool no_work_piece =
      !file.has("solid") && std::none_of(scene.walls.begin(), scene.walls.end(), is_work_piece);
  if (parameters.friction && no_work_piece)
    file.fault("fluid.friction",
               "there is nothing to rub on: friction acts on a [[wall]] with 'work_piece = true' "
               "and on the solid of a coupled case");
  if (parameters.removal && no_work_piece)
    file.fault("fluid.removal",
               "there is nothing to wear: it takes a [[wall]] with 'work_piece = true' or the solid of a "
               "coupled case");
  if (parameters.similarity && scene.gravity_change)
    file.fault("case.gravity_change",
               "a flow whose density is chosen knows of no gravity that changes: leave one of the two out");
  if (parameters.enclosed_medium && file.has("solid"))
    file.fault("fluid.enclosed_medium",
               "a solid bears the pressures that move the fluid: give [fluid.background_pressure]");
  const bool pressed =
      std::any_of(scene.walls.begin(), scene.walls.end(), [](const Wall& w) { return w.press; });
  if (pressed && parameters.integrator == fluid::Integrator::midpoint)
    file.fault("fluid.integrator",
               "walls that are pressed go with the 'symplectic' steps alone: others feed them");
  if (const auto& medium = parameters.enclosed_medium; medium && pressed && medium->mean_pressure > 0)
    file.fault("fluid.enclosed_medium.mean_pressure",
               "the walls that are pressed set the mean pressure: leave it out");
  else if (medium && !pressed && !(medium->mean_pressure > 0))
    file.fault("fluid.enclosed_medium", "without a pressed wall the medium needs a 'mean_pressure' above 0");
  if (parameters.held_volume && (pressed || file.has("solid") || parameters.has_open_ends()))
    file.fault("fluid.held_volume",
               "pressed walls, a solid and open ends leave the medium no volume of its own: leave it out");
  if (parameters.wall_slip && file.has("solid"))
    file.fault(
        "fluid.wall_slip",
        "the medium slides along rigid walls alone, and an elastic solid would be no-slip beside them: "
        "leave one of the two out");
}

/// Of what the case is known to make wrong, before the first step.
void warn_of_start(const CaseFile& file, const Scene& scene, const fluid::Parameters& parameters,
                   const FluidModel& model) {
  const auto& particles = model.particles();
  double speed = largest_norm(particles.v, particles.count);
  for (const auto& inlet : parameters.inlets) speed = std::max(speed, inlet.largest_speed_ever());
  const fluid::Start start{.speed = speed,
                           .blow = fluid::hardest_blow(scene, parameters),
                           .gravity = fluid::gravity_on_columns(scene)};
  for (const auto& beyond : fluid::stability_warnings(parameters, start)) log::warn("{}", beyond);
  for (const auto& spoilt : fluid::similarity_warnings(parameters, scene)) log::warn("{}", spoilt);
  for (const auto& abrupt : fluid::abrupt_inlets(parameters)) log::warn("{}", abrupt);
  if (const auto rings = fluid::beyond_thinnest_rings(parameters, scene)) log::warn("{}", *rings);
  if (!file.value<double>("fluid.removal.grain_length"))
    if (const auto unknown = fluid::removal_by_grain_length(parameters)) log::warn("{}", *unknown);
  if (const auto beyond = fluid::beyond_measured(parameters, scene.geometry)) log::warn("{}", *beyond);
  for (const auto& face : fluid::misplaced_faces(scene.walls, parameters)) log::warn("{}", face);
  for (const auto& thin : fluid::thin_remains(scene.walls, model.reach())) log::warn("{}", thin);
  for (const auto& gap : gap_warnings(file, scene)) log::warn("{}", gap);
  for (const auto& unknown : unknown_meetings(file, scene)) log::warn("{}", unknown);
  for (const auto& misfit : model.misfits()) log::warn("{}", fluid::misfit_text(misfit, parameters.spacing));
  for (const auto& wall : model.boundaries()) warn_of_thin_wall(wall, parameters.spacing, parameters, scene);
  if (const auto jet = fluid::beyond_thinnest_jet(particles, model.boundaries(), parameters.spacing,
                                                  Period(scene).shifts()))
    log::warn("{}", *jet);
}

std::vector<Part> solid_parts(const CaseFile& file, const Scene& scene) {
  std::vector<Part> parts;
  for (const Body& body : CaseBodies(file, scene).solid) parts.push_back(body.part);
  return parts;
}

/// Refuses what needs walls all around where there is a free surface at the start.
void check_enclosed(FluidModel& model, const fluid::Parameters& parameters) {
  const bool implicit = parameters.model == fluid::Model::implicit;
  if (!(parameters.enclosed_medium || parameters.held_volume || implicit) || model.is_enclosed()) return;
  if (parameters.enclosed_medium)
    throw BadKey("fluid.enclosed_medium",
                 "the fluid has a free surface at the start, where its pressure is 0: it is not enclosed");
  if (parameters.held_volume)
    throw BadKey("fluid.held_volume", "the fluid has a free surface at the start: nothing holds its volume");
  const auto [key, message] = fluid::implicit_surface_fault();
  throw BadKey(key, message);
}

/// What the case says, complete and checked but for what only its particles show.
struct Prepared {
  Scene scene = {};
  fluid::Parameters parameters = {};
  std::optional<fluid::Parameters> twin = {};
  Scene real_scene = {};        ///< where a flow of similarity is computed
  std::string similarity = {};  ///< what is told of that
};

/// Of what was read from `file`; the log tells of what is made of it.
Prepared prepare(CaseFile& file, const Scene& scene, fluid::Parameters parameters) {
  const auto add = [&](const std::vector<fluid::StartFault>& faults) {
    for (const auto& [key, message] : faults) file.fault(key, message);
  };
  for (const auto& [key, message] : fluid::axis_faults(parameters, scene)) file.fault(key, message);
  file.throw_if_faulty();  // open ends have as many rows as there are spacings
  if (parameters.has_open_ends()) add(fluid::open_end_faults(parameters, scene, solid_parts(file, scene)));
  add(fluid::process_faults(parameters, scene));
  file.throw_if_faulty();
  fluid::leave_out(left_out_of_fluid(file, scene), parameters);
  fluid::repeat_holes(Period(scene), parameters);
  for (const auto& taken : fluid::complete_medium(parameters)) log::info("{}", taken);
  for (const auto& [key, message] : fluid::similarity_faults(parameters, scene.geometry, file.has("solid")))
    file.fault(key, message);
  add(fluid::implicit_faults(parameters, scene, file.has("solid")));
  file.throw_if_faulty();
  Prepared prepared{.scene = scene, .twin = fluid::implicit_twin(parameters, scene), .real_scene = scene};
  if (parameters.similarity) {
    prepared.similarity = fluid::make_similar(parameters, prepared.scene);
    log::info("{}", prepared.similarity);
  }
  prepared.parameters = std::move(parameters);
  return prepared;
}

Prepared read_again(const Options& options) {
  CaseFile file(options.case_path, options.overrides);
  const Scene scene = read_scene(file);
  fluid::Parameters parameters;
  file.read("fluid", parameters, "");
  file.ignore_sections({"solid", "coupling"});
  return prepare(file, scene, std::move(parameters));
}

ExitCode solve(const Options& options) {
  CaseFile file(options.case_path, options.overrides);
  const Scene read = read_scene(file);
  fluid::Parameters given;
  file.read("fluid", given, "a weakly compressible fluid by delta-SPH");
  file.ignore_sections({"solid", "coupling"});
  check_sections(file, read, given);
  if (options.describe) {
    print(file.description());
    return ExitCode::done;
  }
  check_folder(file, options.out);
  const Prepared prepared = prepare(file, read, std::move(given));
  if (options.outlook && !prepared.similarity.empty()) print("[fluid]: " + prepared.similarity + '\n');
  const Scene& scene = prepared.scene;
  const fluid::Parameters& parameters = prepared.parameters;
  if (options.outlook && !file.has("solid")) tell_flow(parameters, scene);
  for (const auto& [key, message] : fluid::start_faults(parameters, scene)) file.fault(key, message);
  file.throw_if_faulty();
  const auto made = file.placed("fluid", [&] { return fluid::make_spread_model(parameters, scene); });
  FluidModel& model = *made;
  omp_set_num_threads(thread_count(options, model.particle_count(), particles_per_thread));
  file.placed("fluid", [&] {
    check_start(model, "fluid");
    check_enclosed(model, parameters);
  });
  model.record_surface(options.out);  // which has columns
  check_columns(file, model.observe(), "fluid");
  file.throw_if_faulty();
  const SeriesColumns series =
      series_columns("fluid", file.has("solid") ? model.observe_beside_solid() : model.observe());
  check_references(file, scene, series);
  file.throw_if_faulty();
  warn_of_start(file, scene, parameters, model);
  check_secured(options, file.has("solid"), "fluid");
  if (options.check) {  // in a run the solid tells its spacing, whoever plays it
    write_start(options.start_frames, "fluid", model);
    warn_of_coarse_work_piece(file.value<double>("solid.spacing").value_or(0), parameters);
    for (const auto& line : motion_lines(file, scene)) print("[case]: " + line + '\n');
    if (options.outlook) tell_outlook(model, scene.end_time, prepared.twin, prepared.real_scene);
    if (options.columns) print(listed(series));
    return ExitCode::done;
  }
  if (file.has("solid"))
    compute_coupled(options, file, scene, parameters, model);
  else
    compute_alone(options, file, scene, model);
  return ExitCode::done;
}

constexpr std::size_t most_particles = std::numeric_limits<int>::max();  // nobody knows how many yet

/// The case of the program's arguments, for a process that computes a part of it and says nothing.
std::pair<fluid::Parameters, Scene> find_part(int argc, char** argv) {
  open_log("fluid_solver", "", "error");
  const Options options = parse_options("fluid_solver", {argv + 1, argv + argc});
  Prepared prepared = read_again(options);
  omp_set_num_threads(thread_count(options, most_particles, particles_per_thread));
  return {std::move(prepared.parameters), std::move(prepared.scene)};
}

}  // namespace

int main(int argc, char** argv) {
  return toryu::fluid::over_processes(
      argc, argv,
      [&] { return toryu::run_program("fluid_solver", argc, argv, solve, toryu::CanCheckpoint::yes); },
      [&] { return find_part(argc, argv); });
}
