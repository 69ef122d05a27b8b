/// cases/axisymmetric_tube: a medium of 1000 Pa s at the wall, driven through a tube by two pistons.
#pragma once

#include <array>
#include <cmath>

#include "tests/validation/fluid_case.hpp"
#include "tests/validation/tube_solution.hpp"

namespace toryu::fluid {

/// Means over the last 40 % of the run.
struct TubeFlow {
  double pressure_gradient = 0;  ///< over the exact one
  double profile_error = 0;  ///< largest |u - u_exact| of any tenth of the radius, over the largest u_exact
};

/// From the particles within a diameter of the middle between the pistons.
inline TubeFlow run_axisymmetric_tube(const FluidCase& the_case) {
  constexpr std::size_t bins = 10;
  const Parameters& p = the_case.parameters;
  const double diameter = p.similarity->passage_width, radius = 0.5 * diameter;
  const TubeSolution exact([&](double gdot) { return viscosity_of(p, gdot); }, diameter,
                           p.similarity->mean_speed);
  const Box& medium = p.regions.front().box;
  Motion motion;
  for (const auto& wall : the_case.scene.walls)
    if (wall.motion) motion = *wall.motion;  // both pistons move alike
  const EquationOfState state{p.density, p.sound_speed, p.stiffness_exponent, 0};
  WeaklyCompressible solver = the_case.solver();
  std::array<double, bins> difference{}, count{};
  double slopes = 0;
  int samples = 0;
  const double end = the_case.scene.end_time;
  for (double time = 0.6 * end; time < end + 1e-9; time += end / 150) {
    run_until(solver, time);
    const auto& f = solver.particles();
    const double middle = 0.5 * (medium.min[0] + medium.max[0]) + motion.displacement_at(time)[0];
    double n = 0, sum_x = 0, sum_p = 0, sum_xx = 0, sum_xp = 0;
    for (std::size_t i = 0; i < f.count; ++i) {
      const double x = f.x[0][i] - middle, r = f.x[1][i], pressure = state.pressure(f.rho[i]);
      if (std::abs(x) > diameter) continue;
      n += 1, sum_x += x, sum_p += pressure, sum_xx += x * x, sum_xp += x * pressure;
      const auto bin = static_cast<std::size_t>(std::min(r / radius * bins, bins - 1.0));
      difference[bin] += f.v[0][i] - exact.velocity(r);
      count[bin] += 1;
    }
    slopes += (n * sum_xp - sum_x * sum_p) / (n * sum_xx - sum_x * sum_x);
    ++samples;
  }
  TubeFlow flow{slopes / samples / exact.pressure_gradient(), 0};
  for (std::size_t b = 0; b < bins; ++b)
    if (count[b] > 0)
      flow.profile_error =
          std::max(flow.profile_error, std::abs(difference[b] / count[b]) / exact.largest_velocity());
  return flow;
}

}  // namespace toryu::fluid
