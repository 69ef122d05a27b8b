/// The oscillating plate of Gray, Monaghan & Swift (2001), 0.2 m x 0.02 m, held at x = 0 by four columns of
/// fixed particles (an ideal clamp). In two-dimensional plane strain its period is 0.2552 s.
#pragma once

#include <cmath>

#include "tests/unit/solid_solver/samples.hpp"

namespace toryu::solid {

constexpr double plate_period = 0.2552;  // [s], finite elements, ideal clamp

inline Parameters plate(int rows) {
  const double K = 3.25e6, G = 7.15e5, length = 0.2, half = 0.01;
  Parameters p;
  p.material = {.density = 1000,
                .youngs_modulus = 9 * K * G / (3 * K + G),
                .poissons_ratio = (3 * K - 2 * G) / (2 * (3 * K + G))};
  p.spacing = 2 * half / rows;
  p.regions = {{"plate", {Vec(0, -half), Vec(length, half)}},
               {"root", {Vec(-4 * p.spacing, -half), Vec(0, half)}}};
  p.clamps = {{"root", p.regions[1].box}};
  p.observers = {{"tip", Vec(length, 0)}};
  p.initial_velocity = InitialVelocity{VelocityProfile::cantilever_mode_1,
                                       Vec(0, 0.001 * std::sqrt(K / 1000)), Vec(0, 0), length};
  return p;
}

/// Period from zero to zero of the tip, and what the amplitude loses in a period.
struct Vibration {
  double period;          ///< [s]
  double amplitude_loss;  ///< share of the amplitude in one period
};

/// Runs a little over `periods` periods.
inline Vibration vibrate(SolidModel& model, int periods) {
  std::vector<double> upward{0.0}, peaks{0.0};  // one peak for each half period
  double time = 0, y = 0, sign = 1;
  while (peaks.size() < static_cast<std::size_t>(2 * periods + 1) && time < 0.4 * (periods + 1)) {
    const double dt = model.time_step_limit();
    for (int n = 0; n < 25; ++n) model.advance(dt);
    time += 25 * dt;
    const double y_before = y;
    y = observed(model, "tip_displacement_y");
    if (y * sign < 0) {
      if (sign < 0) upward.push_back(time - 25 * dt * y / (y - y_before));
      sign = -sign;
      peaks.push_back(0.0);
    }
    peaks.back() = std::max(peaks.back(), std::abs(y));
  }
  // The peak in progress is complete only if its end was seen; the first and the one before last are.
  const std::size_t last = peaks.size() - 2;
  const double cycles = static_cast<double>(last) / 2.0;
  const Vibration result{upward.back() / static_cast<double>(upward.size() - 1),
                         1.0 - std::pow(peaks[last] / peaks[0], 1.0 / cycles)};
  std::printf("period %.4f s (%+.2f %%), amplitude loss %.2f %% a period\n", result.period,
              100 * (result.period / plate_period - 1), 100 * result.amplitude_loss);
  return result;
}

}  // namespace toryu::solid
