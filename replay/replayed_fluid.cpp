/// A fluid that answers with what another run recorded, so that a solid can be validated alone. Usage as
/// fluid_solver, with `--record RESULTS`.
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/state/checkpoint.hpp"
#include "replay/recording.hpp"

namespace {

using namespace toryu;

constexpr const char* role = "replayed_fluid";

/// All that it answers is in the record.
void nothing(std::ostream&) {}

ExitCode run(const Options& options) {
  const CaseFile file(options.case_path, options.overrides);
  replay::Recording recording(options.record, file);
  if (options.check || options.describe) return ExitCode::done;
  FluidLink link({.role = role,
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_checkpoint = true});
  try {
    recording.check(link.join(recording.start().traits));
    while (const auto turn = link.next_turn()) {
      if (turn->task == Task::checkpoint) {
        link.confirm_checkpoint([&] { write_part(turn->checkpoint, "fluid", role, nothing); });
        continue;
      }
      const FluidAnswer answer = recording.fluid_over(*turn, turn->motion.impulse);
      link.send(answer.load, answer.time_step_limit, answer.health);
    }
  } catch (...) {
    link.leave();
    throw;
  }
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(role, argc, argv, run, CanCheckpoint::yes);
}
