/// The constants and formulas of the fluid, as plain numbers that go to all ranks as they are.
///
/// Equations: delta-SPH (Marrone, Antuono, Colagrossi, Colicchio, Le Touze & Graziani 2011), artificial
/// viscosity (Monaghan 1992), laminar viscosity (Morris, Fox & Zhu 1997), walls (Adami, Hu & Adams 2012).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/vector.hpp"

namespace toryu::lammps_fluid {

/// Types of LAMMPS's atoms, and which of them a number (tag) belongs to: in this order.
enum Type { fluid = 1, wall = 2, interface = 3 };

struct Physics {
  int fluid_count = 0, wall_count = 0, interface_count = 0;
  double spacing = 0, h = 0;   ///< [m]
  double rho_0 = 0, c_0 = 0;   ///< [kg/m3], [m/s]
  int gamma = 7;               ///< exponent of the equation of state
  double delta = 0;            ///< of the density diffusion
  double alpha = 0, beta = 0;  ///< of the artificial viscosity
  double mu = 0;               ///< [Pa s]
  double gravity[dim] = {};    ///< [m/s2]
  double low[dim] = {};        ///< of the domain [m]
  double high[dim] = {};       ///< [m]
  double skin = 0;             ///< margin of the lists of neighbours [m]
  double largest_speed = 0;    ///< [m/s]
  double largest_change = 0;   ///< of the density, share of rho_0
  bool wendland = false, renormalised = false, no_slip = true, suction = true, midpoint = false;

  double support() const { return 2 * h; }
  double p_0() const { return rho_0 * c_0 * c_0 / gamma; }
  double pressure(double rho) const {
    double power = rho / rho_0;
    for (int k = 1; k < gamma; ++k) power *= rho / rho_0;
    return p_0() * (power - 1);
  }
  /// At a depth under the free surface, where the fluid is at rest [kg/m3].
  double density_at_depth(double g, double depth) const {
    const double n = gamma - 1.0, share = g * depth / (c_0 * c_0);
    return rho_0 * (n > 0 ? std::pow(1 + n * share, 1 / n) : std::exp(share));
  }
};

/// Monaghan & Lattanzio (1985), and Wendland C2 (1995) with the same support 2h.
struct CubicSpline {
  explicit CubicSpline(double h)
      : inverse_h(1 / h), factor(10 / (7 * std::numbers::pi) / (4 * h * h)), slope(-3 * factor / h) {}
  double value(double r) const {
    const double q_2 = std::max(2 - r * inverse_h, 0.0), q_1 = std::max(1 - r * inverse_h, 0.0);
    return factor * (q_2 * q_2 * q_2 - 4 * (q_1 * q_1 * q_1));
  }
  /// dW/dr / r [1/m4]: gradW_ij is x_ij times this.
  double gradient_over_r(double r) const {
    const double q_2 = std::max(2 - r * inverse_h, 0.0), q_1 = std::max(1 - r * inverse_h, 0.0);
    return slope * (q_2 * q_2 - 4 * (q_1 * q_1)) / r;
  }
  double inverse_h, factor, slope;
};
struct WendlandC2 {
  explicit WendlandC2(double h)
      : inverse_h(1 / h), factor(7 / (4 * std::numbers::pi * h * h)), slope(-5 * factor / (h * h)) {}
  double value(double r) const {
    const double q = std::max(1 - 0.5 * r * inverse_h, 0.0);
    return factor * (q * q * q * q) * (1 + 2 * inverse_h * r);
  }
  double gradient_over_r(double r) const {
    const double q = std::max(1 - 0.5 * r * inverse_h, 0.0);
    return slope * (q * q * q);
  }
  double inverse_h, factor, slope;
};

}  // namespace toryu::lammps_fluid
