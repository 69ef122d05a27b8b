/// The frame of a program: its command line, and how it ends.
#pragma once

#include <functional>
#include <string>

#include "common/error/failure.hpp"
#include "common/run/options.hpp"

namespace toryu {

/// Whether a program can write its part of a checkpoint and go on from it.
enum class CanCheckpoint { no, yes };

/// Makes the standard streams safe, parses the command line, sets up the log (in `out`, unless the case is
/// only checked or described), runs `body` and turns what it throws into an exit code and one line on
/// standard error and in the log.
/// `--version`, `--help`, `--can-checkpoint`, `--print-case`, `--resolved` and wrong options end here. `role`
/// is the program's name: "fluid_solver".
int run_program(const std::string& role, int argc, char** argv,
                const std::function<ExitCode(const Options&)>& body,
                CanCheckpoint can_checkpoint = CanCheckpoint::no);

}  // namespace toryu
