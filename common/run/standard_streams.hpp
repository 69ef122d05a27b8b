/// The standard streams, which may be closed, full, or read by nobody: a run must not depend on them.
#pragma once

#include <string_view>

namespace toryu {

/// Opens the descriptors 0 to 2 on /dev/null where they are closed, so that no file of the results gets one
/// of them and with it what is meant for a terminal. From now on a reader that goes away, or a file that
/// becomes too large, is an error of the write and no signal that kills.
void secure_standard_streams();

/// Writes to standard output what the user asked for. A reader that went away has read enough; throws
/// MachineFailure if it cannot be written for another reason.
void print(std::string_view text);

/// Writes to standard error what is good to know; if nobody can read it, that is no fault.
void tell(std::string_view text) noexcept;

}  // namespace toryu
