#include "fluid_solver/implicit/solver_parameters.hpp"

namespace toryu::fluid {

void describe(ParameterTable& table, ImplicitSolver& solver) {
  table.number(
      "expected_speed", solver.expected_speed,
      {.unit = "m/s",
       .minimum = 0,
       .help = "that the medium will reach, as in a narrow passage: no step is longer than it allows, "
               "the first ones neither"});
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
