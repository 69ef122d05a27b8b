/// A fluid whose particles LAMMPS carries, over one or more ranks of MPI: takes the place of fluid_solver.
///
///     lammps_fluid CASE [--out DIR]                          one rank
///     lammps_fluid_mpirun CASE [--out DIR]                   RANKS of them
#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "common/link/participant.hpp"
#include "common/run/interruption.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/state/checkpoint.hpp"
#include "common/state/serialize.hpp"
#include "engine.hpp"

namespace {

using namespace toryu;
using namespace toryu::lammps_fluid;

constexpr const char* role = "lammps_fluid";

/// The fluid with its step limit: all that a window depends on.
struct Run {
  Fluid fluid;
  Parameters parameters;
  Extremes extremes;
  double time = 0;
  long steps = 0;

  double limit() const { return parameters.time_step_limit(extremes.speed, extremes.acceleration); }
  /// In equal steps, as few as the limit allows; divided anew where it falls.
  template <class Taken>
  void advance(double end, Taken&& taken) {
    while (time < end) {
      const double left = end - time, count = std::ceil(left / limit() - 1e-9);
      const double dt = left / std::max(count, 1.0);
      extremes = fluid.step(time, dt);
      ++steps;
      time = count <= 1 ? end : time + dt;
      taken();
    }
  }
  Numbers state() {
    Numbers all = fluid.call(Order::give_state);
    all.insert(all.end(), {extremes.speed, extremes.acceleration, time});
    return all;
  }
  void set_state(Numbers all) {
    const std::size_t end = all.size();
    time = all[end - 1], extremes.acceleration = all[end - 2], extremes.speed = all[end - 3];
    all.resize(end - 3);
    fluid.call(Order::take_state, std::move(all));
  }
};

void note_start(const Start& start, const Parameters& parameters, Run& run) {
  run.parameters = parameters;
  for (const Region& region : parameters.regions)
    run.extremes.speed = std::max(run.extremes.speed, region.velocity.norm());
  run.fluid.fill(start);
}

InterfaceLoad load_of(const Numbers& taken, double dt, std::size_t count, bool with_impedance) {
  InterfaceLoad load;
  for (int a = 0; a < dim; ++a) load.impulse_on_fluid[a] = taken[static_cast<std::size_t>(a)];
  load.work_of_impulse = taken[dim];
  const auto* values = taken.data() + dim + 1;
  for (std::size_t k = 0; k < count; ++k) load.pressure.push_back(values[k] / dt);
  for (std::size_t n = 0; n < dim * count; ++n) load.force.push_back(values[count + n] / dt);
  if (with_impedance) load.impedance.assign(values + 3 * count, values + 5 * count);
  return load;
}

Health health_of(Run& run) {
  const Numbers found = run.fluid.call(Order::observe);
  return {.kinetic_energy = found[0], .potential_energy = found[1], .momentum = Vec(found[2], found[3])};
}

void compute_window(FluidLink& link, const FluidLink::Turn& turn, Run& run) {
  const bool with_impulse = !turn.motion.impulse.empty();
  Numbers motion{turn.time, turn.dt, with_impulse ? 1.0 : 0.0};
  for (const auto* values : {&turn.motion.position, &turn.motion.velocity, &turn.motion.impulse})
    motion.insert(motion.end(), values->begin(), values->end());
  run.time = turn.time;
  run.fluid.call(Order::begin_window, std::move(motion));
  run.advance(turn.time + turn.dt, [&] { link.count_step(); });
  const Numbers taken = run.fluid.call(Order::take_load, {with_impulse ? 1.0 : 0.0});
  link.send(load_of(taken, turn.dt, turn.motion.position.size() / dim, with_impulse), run.limit(),
            health_of(run));
}

/// From the start, or from where a checkpoint has the fluid.
void begin(const std::filesystem::path& checkpoint, Start start, const Parameters& parameters, Run& run) {
  if (checkpoint.empty()) return note_start(start, parameters, run);
  Numbers state;
  read_part(checkpoint, "fluid", {role}, [&](std::istream& stream) { read_states(stream, state); });
  // Each particle starts on the rank that has its place.
  for (std::size_t i = 0; i < static_cast<std::size_t>(start.physics.fluid_count); ++i)
    for (std::size_t a = 0; a < dim; ++a) start.position[dim * i + a] = state[6 * i + a];
  note_start(start, parameters, run);
  run.set_state(std::move(state));
}

void take_turns(FluidLink& link, Run& run) {
  Numbers kept;
  while (const auto turn = link.next_turn()) {
    if (turn->task == Task::checkpoint) {
      link.confirm_checkpoint([&] {
        Numbers state = run.state();
        write_part(turn->checkpoint, "fluid", {role},
                   [&](std::ostream& stream) { write_states(stream, state); });
      });
      continue;
    }
    if (turn->iteration > 0)
      run.set_state(kept);
    else if (link.windows_repeat())
      kept = run.state();
    compute_window(link, *turn, run);
  }
}

void compute_coupled(const Options& options, const CaseFile& file, const Case& of) {
  FluidLink link({.role = role,
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_repeat = true,
                  .can_checkpoint = true,
                  .used_case = file.used()});
  try {
    Run run;
    const Parameters& p = of.parameters;
    const Interface interface = link.join({.reach = 2 * p.h(),
                                           .time_step_limit = p.time_step_limit(0, 0),
                                           .density = p.density,
                                           .sound_speed = p.sound_speed,
                                           .spacing = p.spacing});
    begin(link.restart(), fill(of, interface.position, interface.volume), p, run);
    take_turns(link, run);
  } catch (...) {
    link.leave();
    throw;
  }
}

/// Rows of time, energies, largest speed and observers.
class Series {
 public:
  Series(const std::filesystem::path& out, const Parameters& parameters) : parameters_(parameters) {
    std::filesystem::create_directories(out);
    file_.open(out / "fluid.csv");
    file_ << "time[s],steps[1],kinetic_energy[J/m],potential_energy[J/m],largest_speed[m/s]";
    for (const Observer& o : parameters.observers) {
      const bool is_pressure = o.quantity == Observer::Quantity::pressure;
      file_ << fmt::format(",{}[{}]", o.name, is_pressure ? "Pa" : "m");
      if (is_pressure) points_.insert(points_.end(), o.point.begin(), o.point.end());
    }
    file_ << '\n';
  }
  void write(Run& run) {
    const Numbers found = run.fluid.call(Order::observe, points_);
    file_ << fmt::format("{:.17g},{},{:.17g},{:.17g},{:.17g}", run.time, run.steps, found[0], found[1],
                         run.extremes.speed);
    std::size_t next = 5;
    for (const Observer& o : parameters_.observers)
      file_ << fmt::format(",{:.17g}", o.quantity == Observer::Quantity::pressure
                                           ? found[next++]
                                           : found[4] + 0.5 * parameters_.spacing);
    file_ << '\n' << std::flush;
  }

 private:
  const Parameters& parameters_;
  std::ofstream file_;
  Numbers points_;
};

void compute_alone(const Options& options, const Case& of) {
  Run run;
  note_start(fill(of, {}, {}), of.parameters, run);
  Series series(options.out, of.parameters);
  series.write(run);
  for (long row = 1; run.time < of.scene.end_time; ++row) {
    const double next = static_cast<double>(row) * of.scene.series_interval;
    const double end = of.scene.series_interval > 0 ? next : run.time + run.limit();
    run.advance(std::min(end, of.scene.end_time), [] { throw_if_interrupted(); });
    series.write(run);
  }
}

/// lammps_fluid_mpirun sends SIGUSR1 for an interruption. By SIGTERM mpirun ends a job that has lost a rank.
void catch_signals_of_mpirun() {
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) return;
  std::signal(SIGUSR1, [](int) { std::raise(SIGINT); });
  std::signal(SIGTERM, SIG_DFL);
}

ExitCode solve(const Options& options) {
  catch_signals_of_mpirun();
  CaseFile file(options.case_path, options.overrides);
  const Case of = read_case(file);
  if (options.check) {
    fill(of, {}, {});
  } else if (file.has("solid")) {
    compute_coupled(options, file, of);
  } else {
    compute_alone(options, of);
  }
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);  // without mpirun: starts no helper of its own
  MPI_Init(&argc, &argv);
  int rank = 0, code = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    code = run_program(role, argc, argv, solve, CanCheckpoint::yes);
  } else {
    std::signal(SIGUSR1, SIG_IGN);  // for rank 0
    serve();
  }
  MPI_Finalize();
  return code;
}
