/// How an exception ends a run, and how the end of a run becomes an exception in another process.
#pragma once

#include <string>

#include "common/error/failure.hpp"

namespace toryu {

struct Ending {
  ExitCode code = ExitCode::done;
  std::string reason;
};

/// Of the exception that is being handled; call it within a catch block.
Ending ending_of_exception() noexcept;

/// Throws what `ending` stands for: the way a process learns of another's end. Must not be `done`.
[[noreturn]] void throw_ending(const Ending& ending);

}  // namespace toryu
