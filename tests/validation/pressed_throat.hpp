/// cases/abrasive_throat/pressed.toml: a medium between two pistons whose pressures are set.
#pragma once

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

/// Means over the second half of the run.
struct PressedThroat {
  double drop = 0;  ///< over the drop of the reference at the pistons' speed
  // contact pressure beside the middle of the pistons' faces less that of its press, over the larger press
  double upstream = 0, downstream = 0;
};

inline const PressedMotion& pressed_motion(const WeaklyCompressible& solver, const std::string& name) {
  for (const auto& boundary : solver.boundaries())
    if (boundary.name == name) return std::get<PressedMotion>(boundary.motion);
  throw std::out_of_range(name);
}

inline PressedThroat run_pressed_throat(const FluidCase& the_case) {
  constexpr double drop_of_reference = 70.8e6;  // at 1 m/s, of the staggered-grid solution [Pa]
  constexpr double start = -0.014, end = 0.010, axis = 0.003, probe = 0.0096, half = 0.0005;
  WeaklyCompressible solver = the_case.solver();
  const auto& pushing = pressed_motion(solver, "pushing_piston");
  const auto& leading = pressed_motion(solver, "leading_piston");
  // In a square of 1 mm about (x, axis) [Pa].
  const auto pressure = [&](double x) {
    const auto& f = solver.particles();
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < f.count; ++i)
      if (std::abs(f.x[0][i] - x) < half && std::abs(f.x[1][i] - axis) < half) sum += f.p[i], ++count;
    return sum / count + solver.pressure_offset();
  };
  PressedThroat sum;
  double drop = 0, speed = 0;
  int samples = 0;
  for (double time = 0.5 * the_case.scene.end_time; time < the_case.scene.end_time; time += 0.002) {
    run_until(solver, time);
    drop += pressure(-probe) - pressure(probe);
    speed += 0.5 * (pushing.speed - leading.speed);
    const double most = pushing.press.pressure_at(time, 1), least = leading.press.pressure_at(time, 1);
    sum.upstream += (pressure(start + pushing.way_at(time) + half) - most) / most;
    sum.downstream += (pressure(end - leading.way_at(time) - half) - least) / most;
    ++samples;
  }
  return {drop / speed / drop_of_reference, sum.upstream / samples, sum.downstream / samples};
}

}  // namespace toryu::fluid
