/// The frame of a participant that answers with what another run recorded.
#pragma once

#include "common/link/identity.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/state/checkpoint.hpp"
#include "replay/recording.hpp"

namespace toryu::replay {

/// Runs a program `replayed_fluid` or `replayed_solid` (`side` "fluid" or "solid") by a link of its kind,
/// that can repeat windows or not: `join(link, recording)`, then `answer(link, recording, turn)` in each
/// window. Returns the exit code of the process.
template <class Link, class Join, class Answer>
int run_side(const std::string& side, bool can_repeat, int argc, char** argv, Join join, Answer answer) {
  const std::string role = "replayed_" + side;
  const auto run = [&](const Options& options) {
    if (options.describe) return ExitCode::done;
    const CaseFile file(options.case_path, options.overrides);
    Recording recording(options.record, file);
    check_identity(options.network, side);
    if (options.check) return ExitCode::done;
    Link link({.role = role,
               .version = provenance(1).version,
               .out = options.out,
               .network = options.network,
               .case_hash = file.hash(),
               .can_repeat = can_repeat,
               .can_checkpoint = true});
    try {
      join(link, recording);
      while (const auto turn = link.next_turn()) {
        if (turn->task == Task::window)
          answer(link, recording, *turn);
        else  // all that it answers is in the record
          link.confirm_checkpoint([&] { write_part(turn->checkpoint, side, {role}, [](std::ostream&) {}); });
      }
    } catch (...) {
      link.leave();
      throw;
    }
    return ExitCode::done;
  };
  return run_program(role, argc, argv, run, CanCheckpoint::yes);
}

}  // namespace toryu::replay
