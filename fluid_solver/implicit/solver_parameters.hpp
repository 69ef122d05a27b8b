/// What a case says of how the implicit model solves its steps.
#pragma once

#include "common/case/parameter_table.hpp"

namespace toryu::fluid {

struct ImplicitSolver {
  double expected_speed = 0;           ///< [m/s]
  double tolerance = 1e-4;             ///< of the unbalanced force, over the driving one
  int largest_iterations = 1000;       ///< of a step
  int largest_viscosity_updates = 50;  ///< of a step
};
inline void describe(ParameterTable& table, ImplicitSolver& solver) {
  table.number(
      "tolerance", solver.tolerance,
      {.minimum = 1e-12,
       .maximum = 0.1,
       .help = "unbalanced force at which a step is solved, over the force that drives it (root mean "
               "squares)"});
  table.integer(
      "largest_iterations", solver.largest_iterations,
      {.minimum = 1, .help = "of the linear solver in a step; a step that takes more ends the run"});
  table.integer(
      "largest_viscosity_updates", solver.largest_viscosity_updates,
      {.minimum = 1, .help = "of a viscosity that varies, in a step; a step that takes more ends the run"});
}

}  // namespace toryu::fluid
