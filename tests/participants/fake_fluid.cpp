/// A fluid that is no more than a given pressure history on the interface: a template for whoever puts
/// another fluid model in the place of fluid_solver.
///
///     p(t) = peak sin^2(pi t / period)
///
/// The pressure pushes against the outward area vectors that the solid registered. Usage as fluid_solver:
///
///     fake_fluid CASE [--out DIR]
#include <cmath>
#include <numbers>

#include "common/case/case_file.hpp"
#include "common/link/participant.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/state/checkpoint.hpp"
#include "common/state/serialize.hpp"

namespace {

using namespace toryu;

constexpr const char* role = "fake_fluid";
constexpr double peak = 1000;    // [Pa]
constexpr double period = 0.02;  // [s]
// Of a real fluid these are its own: its kernel's reach, its step limit, its medium.
constexpr FluidTraits traits{
    .reach = 0.005, .time_step_limit = 1e-4, .density = 1000, .sound_speed = 10, .spacing = 0.0025};

InterfaceLoad load_at(double time, double dt, const Interface& interface) {
  const double s = std::sin(std::numbers::pi * time / period);
  const double pressure = peak * s * s;
  InterfaceLoad load;
  load.pressure.assign(interface.size(), pressure);
  for (const double component : interface.area_vector) load.force.push_back(-pressure * component);
  // What the fluid itself received is the reaction. A real fluid sums it over its own particles, so that the
  // coupler can compare both sums.
  for (std::size_t j = 0; j < interface.size(); ++j)
    for (int c = 0; c < dim; ++c) load.impulse_on_fluid[c] -= dt * load.force[dim * j + c];
  return load;
}

ExitCode run(const Options& options) {
  // A real participant reads its sections here; the hash tells the coupler that both compute the same case.
  const CaseFile file(options.case_path, options.overrides);
  FluidLink link({.role = role,
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_repeat = true,
                  .can_checkpoint = true});
  double time = 0;  // [s]; all that its next window depends on. A real fluid has its fields beside it
  try {
    const Interface interface = link.join(traits);
    if (const auto folder = link.restart(); !folder.empty())
      read_part(folder, "fluid", {role}, [&](std::istream& stream) { read_states(stream, time); });
    while (const auto turn = link.next_turn()) {
      if (turn->task == Task::checkpoint) {
        link.confirm_checkpoint([&] {
          write_part(turn->checkpoint, "fluid", {role},
                     [&](std::ostream& stream) { write_states(stream, time); });
        });
        continue;
      }
      // A real fluid goes back to the start of this window if turn->iteration > 0, and else keeps its state
      // for that. It moves its copy of the interface to turn->motion, takes its steps of at most its own
      // limit, and calls count_step after each.
      if (turn->iteration == 0 && std::abs(turn->time - time) > 1e-9 * turn->dt)
        throw std::logic_error("the window does not begin where the last one ended");
      time = turn->time + turn->dt;
      const InterfaceLoad load = load_at(turn->time + 0.5 * turn->dt, turn->dt, interface);
      link.count_step();
      link.send(load, traits.time_step_limit, Health{});
    }
  } catch (...) {
    link.leave();  // the others learn why and end alike
    throw;
  }
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(role, argc, argv, run, CanCheckpoint::yes);
}
