/// A solid that moves as another run recorded, so that a fluid can be validated alone. Usage as solid_solver,
/// with `--record RESULTS`.
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/state/checkpoint.hpp"
#include "replay/recording.hpp"

namespace {

using namespace toryu;

constexpr const char* role = "replayed_solid";

/// All that it answers is in the record.
void nothing(std::ostream&) {}

ExitCode run(const Options& options) {
  const CaseFile file(options.case_path, options.overrides);
  replay::Recording recording(options.record, file);
  if (options.check || options.describe) return ExitCode::done;
  SolidLink link({.role = role,
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_repeat = true,  // its answer depends on the window alone
                  .can_checkpoint = true});
  try {
    recording.check_reach(link.join());
    link.register_interface(recording.start().interface, recording.start().motion);
    while (const auto turn = link.next_turn()) {
      if (turn->task == Task::checkpoint) {
        link.confirm_checkpoint([&] { write_part(turn->checkpoint, "solid", role, nothing); });
        continue;
      }
      const SolidAnswer answer = recording.solid_over(*turn, turn->load);
      link.send(answer.motion, answer.impulse_taken, answer.health);
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
