/// How far the hydrostatic tank is from rest.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

struct TankAtRest {
  double g, depth, c_0, rho_0, gamma;

  /// Exact: rho = rho_0 (1 + (gamma - 1) g (H - y)/c_0^2)^(1/(gamma - 1)).
  double pressure(double y) const {
    const double n = gamma - 1;
    const double rho_ratio = std::pow(1 + n * g * (depth - y) / (c_0 * c_0), 1 / n);
    return rho_0 * c_0 * c_0 / gamma * (std::pow(rho_ratio, gamma) - 1);
  }
  /// Largest |p - p_exact| of any particle over rho_0 g H.
  double pressure_error(const WeaklyCompressible& solver) const {
    const EquationOfState state{rho_0, c_0, static_cast<int>(gamma)};
    const auto& f = solver.particles();
    double largest = 0;
    for (std::size_t k = 0; k < f.count; ++k)
      largest = std::max(largest, std::abs(state.pressure(f.rho[k]) - pressure(f.x[1][k])));
    return largest / (rho_0 * g * depth);
  }
  /// Kinetic energy over m g H, m the mass of the water.
  double motion(const WeaklyCompressible& solver) const {
    double mass = 0;
    for (const double m : solver.particles().m) mass += m;
    return solver.kinetic_energy() / (mass * g * depth);
  }
};

/// Runs the tank to `end_time` and holds every particle, every tenth of a second, to 1 % in pressure, and the
/// whole to 1e-6 in kinetic energy.
inline void expect_rest(const std::vector<std::string>& overrides, double end_time) {
  const FluidCase the_case("hydrostatic_tank", overrides);
  const auto& p = the_case.parameters;
  const TankAtRest tank{the_case.scene.gravity.norm(), p.hydrostatic_start->surface_level, p.sound_speed,
                        p.density, static_cast<double>(p.stiffness_exponent)};
  WeaklyCompressible solver = the_case.solver();
  double pressure = 0, motion = 0;
  for (int n = 1; 0.1 * n < end_time + 0.05; ++n) {
    run_until(solver, 0.1 * n);
    pressure = std::max(pressure, tank.pressure_error(solver));
    motion = std::max(motion, tank.motion(solver));
  }
  ::testing::Test::RecordProperty("largest_pressure_error", std::to_string(pressure));
  ::testing::Test::RecordProperty("largest_kinetic_energy", fmt::format("{:.3g}", motion));
  EXPECT_LT(pressure, 0.01);
  EXPECT_LT(motion, 1e-6);
}

}  // namespace toryu::fluid
