/// cases/axisymmetric_throat: a medium of 1000 Pa s, pressed through a round throat.
#pragma once

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

/// Pressure drop over that of the reference; mean over the second half of the run.
inline double run_axisymmetric_throat(const FluidCase& the_case) {
  constexpr double reference = 5.22e6;  // of a staggered-grid solution [Pa]
  WeaklyCompressible solver = the_case.solver();
  double sum = 0;
  int samples = 0;
  const double end = the_case.scene.end_time;
  for (double time = 0.5 * end; time < end + 1e-9; time += end / 100) {
    run_until(solver, time);
    double up = 0, down = 0;
    for (const auto& [name, unit, value] : solver.observe()) {
      if (name == "pressure_upstream") up = value;
      if (name == "pressure_downstream") down = value;
    }
    sum += up - down;
    ++samples;
  }
  return sum / samples / reference;
}

}  // namespace toryu::fluid
