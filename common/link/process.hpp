/// Whether a peer's process runs, as its own machine sees it. A busy machine delays signs of life; who is
/// late is not dead.
#pragma once

#include <string>

namespace toryu {

/// Names this process for others: its machine, its number there, and when it started.
std::string own_process();

/// Whether the process so named is on this machine and runs: neither gone nor stopped (SIGSTOP). False too if
/// that cannot be known from here.
bool runs_here(const std::string& process);

}  // namespace toryu
