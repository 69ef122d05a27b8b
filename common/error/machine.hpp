/// Faults of the machine: what the system refuses, as the number that it gives (errno), in words with a
/// remedy.
#pragma once

#include <stdexcept>
#include <string>
#include <system_error>

namespace toryu {

/// The machine does not give what the run needs: no room on the disk, no port, no thread. Neither the case
/// nor the program is at fault.
class MachineFailure : public std::runtime_error {
 public:
  /// `what` could not be done ("cannot write 'fluid.csv'") for the reason `error`, an errno.
  MachineFailure(const std::string& what, int error);
  /// In words of its own, or as told by another process.
  explicit MachineFailure(const std::string& text) : std::runtime_error(text) {}
};

/// Whether `error` (an errno) says that a path is wrong as it was given, not that the machine is short of
/// something.
bool is_fault_of_path(int error);

/// What the standard library tells of the system, as a failure of the machine: "cannot rename 'a': ...".
MachineFailure machine_failure(const std::system_error& error);

}  // namespace toryu
