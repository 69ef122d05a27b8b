/// Equation of state (3): p = p_0 [(rho/rho_0)^gamma - 1] + p_b, p_0 = rho_0 c_0^2/gamma (Monaghan 1994).
///
/// The background pressure p_b is 0 unless the case gives one. It stands for the pressure at which a machine
/// holds its medium: the rest density then belongs to p_b, and the medium falls below p = 0 only where a
/// suction exceeds it. Numerically, sum_j 2 p_b V_j gradW_ij pushes particles apart where they are crowded,
/// so that they stay evenly spread (Colagrossi, Bouscasse, Antuono & Marrone 2012).
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "common/case/parameter_table.hpp"
#include "common/sph/lanes.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// The pressure at which a closed medium is held, at rest density [Pa].
struct BackgroundPressure {
  static constexpr const char* section = "background_pressure";
  static constexpr const char* help =
      "added to the pressure; for a medium enclosed on all sides, a free surface would burst";
  double pressure = 0;
};
inline void describe(ParameterTable& table, BackgroundPressure& background) {
  table.number("pressure", background.pressure,
               {.unit = "Pa",
                .minimum = 0,
                .required = true,
                .help = "of the medium at rest density; keeps a closed medium from tearing under suction"});
}

struct EquationOfState {
  double rho_0, c_0;
  int gamma;
  double p_b = 0;

  double p_0() const { return rho_0 * c_0 * c_0 / gamma; }

  template <class T>
  T pressure(const T& rho) const {
    const T ratio = rho * (1.0 / rho_0);
    T power = ratio;
    for (int k = 1; k < gamma; ++k) power *= ratio;
    return p_0() * (power - 1.0) + p_b;
  }
  /// Density at pressure p [Pa].
  double density(double p) const { return rho_0 * std::pow((p - p_b) / p_0() + 1.0, 1.0 / gamma); }
  /// Energy of compression over the volume at rest: rho_0 times the integral of p/rho^2 over the density,
  /// from rho_0 [J/m3].
  double elastic_energy(double rho) const {
    const double n = gamma - 1.0, ratio = rho / rho_0;
    const double growth = n > 0 ? (std::pow(ratio, n) - 1) / n : std::log(ratio);
    return p_0() * (growth + 1 / ratio - 1) + p_b * (1 - 1 / ratio);
  }
};

inline ActiveTerm text(const BackgroundPressure& background, const Medium&) {
  return {"background pressure", "p_b added to the equation of state",
          "Colagrossi, Bouscasse, Antuono & Marrone 2012", fmt::format("p_b {} Pa", background.pressure)};
}

}  // namespace toryu::fluid
