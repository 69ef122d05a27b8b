/// A solid whose motion is given: an upright strip of particles that sways as a whole. A template for whoever
/// puts another solid model in the place of solid_solver.
///
///     x(t) = X + (amplitude (1 - cos(2 pi t / period)), 0)
///
/// Usage as solid_solver:
///
///     fake_solid CASE [--out DIR]
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

constexpr const char* role = "fake_solid";
constexpr double amplitude = 1e-3;  // [m]
constexpr double period = 0.02;     // [s]
constexpr double spacing = 1e-3;    // [m]
constexpr double density = 1100;    // [kg/m3]
constexpr int rows = 40;
constexpr int sub_steps = 10;  // in a window

/// One column of particles that touches fluid on its left, so that a pressure has a resultant.
Interface strip() {
  Interface interface;
  interface.spacing = spacing;
  for (int row = 0; row < rows; ++row) {
    interface.id.push_back(static_cast<std::uint32_t>(row));
    interface.position.insert(interface.position.end(), {0.1 + 0.5 * spacing, (row + 0.5) * spacing});
    interface.volume.push_back(spacing * spacing);
    interface.mass.push_back(density * spacing * spacing);
    interface.area_vector.insert(interface.area_vector.end(), {-spacing, 0.0});
  }
  return interface;
}

InterfaceMotion motion_at(double time, const Interface& interface) {
  const double omega = 2 * std::numbers::pi / period;
  InterfaceMotion motion{interface.position, {}};
  for (std::size_t j = 0; j < interface.size(); ++j) {
    motion.position[dim * j] += amplitude * (1 - std::cos(omega * time));
    motion.velocity.insert(motion.velocity.end(), {amplitude * omega * std::sin(omega * time), 0.0});
  }
  return motion;
}

/// All that acts on the strip: the load's two forces.
Vec sum_of(const InterfaceLoad& load) {
  Vec sum = Vec::Zero();
  for (const auto* forces : {&load.force, &load.friction_force})
    for (std::size_t k = 0; k < forces->size(); ++k) sum[static_cast<int>(k % dim)] += (*forces)[k];
  return sum;
}

ExitCode run(const Options& options) {
  // A real participant reads its sections here; the hash tells the coupler that both compute the same case.
  const CaseFile file(options.case_path, options.overrides);
  SolidLink link({.role = role,
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_repeat = true,
                  .can_checkpoint = true});
  double time = 0;  // [s]; all that its next window depends on. A real solid has its fields beside it
  try {
    link.join();  // returns the fluid's reach, by which a real solid chooses its interface
    const Interface interface = strip();
    link.register_interface(interface, motion_at(0, interface));
    if (const auto folder = link.restart(); !folder.empty())
      read_part(folder, "solid", {role}, [&](std::istream& stream) { read_states(stream, time); });
    while (const auto turn = link.next_turn()) {
      if (turn->task == Task::checkpoint) {
        link.confirm_checkpoint([&] {
          write_part(turn->checkpoint, "solid", {role},
                     [&](std::ostream& stream) { write_states(stream, time); });
        });
        continue;
      }
      // A real solid goes back to the start of this window if turn->iteration > 0.
      if (turn->iteration == 0 && std::abs(turn->time - time) > 1e-9 * turn->dt)
        throw std::logic_error("the window does not begin where the last one ended");
      time = turn->time + turn->dt;
      Vec impulse_taken = Vec::Zero();
      for (int sub_step = 0; sub_step < sub_steps; ++sub_step) {
        impulse_taken += turn->dt / sub_steps * sum_of(turn->load);  // a real solid moves by it
        link.count_step();
      }
      link.send(motion_at(time, interface), impulse_taken, Health{});
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
