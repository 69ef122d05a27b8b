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

namespace {

using namespace toryu;

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
  FluidLink link({.role = "fake_fluid",
                  .version = provenance(1).version,
                  .out = options.out,
                  .case_hash = file.hash(),
                  .can_repeat = true});  // what it does depends on the time alone
  try {
    const Interface interface = link.join(traits);
    while (const auto turn = link.next_window()) {
      // A real fluid goes back to the start of this window if turn->iteration > 0, and else keeps its state
      // for that. It moves its copy of the interface to turn->motion, takes its steps of at most its own
      // limit, and calls count_step after each.
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
  return run_program("fake_fluid", argc, argv, run);
}
