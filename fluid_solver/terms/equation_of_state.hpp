/// Equation of state (3): p = p_0 [(rho/rho_0)^gamma - 1], p_0 = rho_0 c_0^2/gamma (Monaghan 1994).
#pragma once

#include <cmath>

#include "common/sph/lanes.hpp"

namespace toryu::fluid {

struct EquationOfState {
  double rho_0, c_0;
  int gamma;

  double p_0() const { return rho_0 * c_0 * c_0 / gamma; }

  template <class T>
  T pressure(const T& rho) const {
    const T ratio = rho * (1.0 / rho_0);
    T power = ratio;
    for (int k = 1; k < gamma; ++k) power *= ratio;
    return p_0() * (power - 1.0);
  }
  /// Density at pressure p [Pa].
  double density(double p) const { return rho_0 * std::pow(p / p_0() + 1.0, 1.0 / gamma); }
};

}  // namespace toryu::fluid
