/// Whether a peer's process runs, as its own machine sees it. A busy machine delays signs of life; who is
/// late is not dead.
#pragma once

#include <string>

namespace toryu {

/// Names this process for others: its machine, its number there, and when it started.
std::string own_process();

/// `stopped` is by SIGSTOP or a debugger; `unknown` where it cannot be seen from here, as on another machine.
enum class ProcessState { unknown, runs, stopped, gone };

/// What is said of that process when it is lost: "was killed or stopped", or that its host may be the cause.
std::string words_of_loss(const std::string& process);

/// Of the process so named.
ProcessState state_of(const std::string& process);

}  // namespace toryu
