/// What a case says of how the implicit model solves its steps.
#pragma once

#include "common/case/parameter_table.hpp"

namespace toryu::fluid {

struct ImplicitSolver {
  double expected_speed = 0;           ///< that the medium will reach [m/s]
  double tolerance = 1e-4;             ///< of the unbalanced force, over the driving one
  int largest_iterations = 1000;       ///< of a step
  int largest_viscosity_updates = 50;  ///< of a step
};
void describe(ParameterTable& table, ImplicitSolver& solver);

}  // namespace toryu::fluid
