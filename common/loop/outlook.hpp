/// What a run would take, told before it is started.
#pragma once

#include <optional>
#include <string>

#include "common/run/solver.hpp"

namespace toryu {

struct Outlook {
  std::string text;            ///< a line
  std::optional<double> time;  ///< that the run would take [s]; nothing if its first steps fail
};

/// Of the section of the case, "[fluid]": the time step at the start and what limits it, the number of such
/// steps to `end_time` [s], and the time that they take on this machine, by steps that are made and timed:
/// `solver` is advanced.
Outlook outlook(const std::string& section, Solver& solver, double end_time);

}  // namespace toryu
