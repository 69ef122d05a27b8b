/// cases/abrasive_throat/pressed.toml and implicit_pressed.toml: a medium between two pistons whose pressures
/// are set.
#pragma once

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

/// Means over the second half of the run, of every `interval` [s].
struct PressedThroat {
  double drop = 0;  ///< over the drop of the reference at the pistons' speed
  // contact pressure beside the middle of the pistons' faces less that of its press, over the larger press
  double upstream = 0, downstream = 0;
  /// Pressure over the volume less the mean of both presses, over that, while the pistons are within 0.4 mm
  /// of the middle of their way: there the flow is its own image but for the sign of the pressure.
  double mean = 0;
};

inline const PressedMotion& pressed_motion(const FluidModel& solver, const std::string& name) {
  for (const auto& boundary : solver.boundaries())
    if (boundary.name == name) return std::get<PressedMotion>(boundary.motion);
  throw std::out_of_range(name);
}

inline PressedThroat run_pressed_throat(const FluidCase& the_case, double interval = 0.002) {
  constexpr double drop_of_reference = 70.8e6;  // at 1 m/s, of the staggered-grid solution [Pa]
  constexpr double start = -0.014, end = 0.010, axis = 0.003, probe = 0.0096, half = 0.0005;
  const auto model = make_model(the_case.parameters, the_case.scene);
  FluidModel& solver = *model;
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
  const auto mean_pressure = [&] {
    const auto& f = solver.particles();
    double volume = 0, sum = 0;
    for (std::size_t i = 0; i < f.count; ++i) {
      volume += f.m[i] / f.rho[i];
      sum += f.m[i] / f.rho[i] * f.p[i];
    }
    return sum / volume + solver.pressure_offset();
  };
  PressedThroat sum;
  constexpr double middle = 0.002;  // of the pistons' way
  const double half_time = 0.5 * the_case.scene.end_time;
  double drop = 0, speed = 0;
  int samples = 0, in_middle = 0;
  for (double time = 0.5 * half_time; time < the_case.scene.end_time; time += interval) {
    run_until(solver, time);
    const double most = pushing.press.pressure_at(time, 1), least = leading.press.pressure_at(time, 1);
    if (std::abs(pushing.way_at(time) - middle) < 0.0004)
      sum.mean += mean_pressure() / (0.5 * (most + least)) - 1, ++in_middle;
    if (time < half_time - 1e-9) continue;
    drop += pressure(-probe) - pressure(probe);
    speed += 0.5 * (pushing.speed - leading.speed);
    sum.upstream += (pressure(start + pushing.way_at(time) + half) - most) / most;
    sum.downstream += (pressure(end - leading.way_at(time) - half) - least) / most;
    ++samples;
  }
  return {drop / speed / drop_of_reference, sum.upstream / samples, sum.downstream / samples,
          sum.mean / in_middle};
}

}  // namespace toryu::fluid
