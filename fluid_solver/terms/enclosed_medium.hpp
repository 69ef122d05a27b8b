/// The mean pressure of a medium that is enclosed on all sides. Only differences of pressure move such a
/// medium; how high it stands as a whole is what the press sets, and what the few thousandths of compression
/// in the particles' order make of it is an accident. So the pressure that does something at a surface is
///
///     p_i + (p_mean - sum_j V_j p_j/sum_j V_j),
///
/// in contact, friction (33), removal, observers and frames; the sums of the momentum keep p_i.
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "common/sph/points.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

struct EnclosedMedium {
  static constexpr const char* section = "enclosed_medium";
  static constexpr const char* help = "the pressure at which a press holds a medium without free surface";
  double mean_pressure = 0;  ///< [Pa]
};
inline void describe(ParameterTable& table, EnclosedMedium& medium) {
  table.number("mean_pressure", medium.mean_pressure,
               {.unit = "Pa",
                .minimum = 0,
                .required = true,
                .help = "over the volume: what contact, friction, removal and the results have; the motion "
                        "does not depend on it"});
}

/// What is to be added to the pressure of each of the `count` particles of mass `m` [kg/m] and density `rho`
/// [kg/m3]; 0 without a mean pressure [Pa].
inline double pressure_offset(const std::optional<EnclosedMedium>& medium, const Field& m, const Field& rho,
                              std::size_t count, const EquationOfState& state) {
  if (!medium) return 0;
  double volume = 0, sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double V_i = m[i] / rho[i];
    volume += V_i;
    sum += V_i * state.pressure(rho[i]);
  }
  return medium->mean_pressure - sum / volume;
}

inline ActiveTerm text(const EnclosedMedium& medium, const Medium&) {
  return {"enclosed medium", "p_i + (p_mean - sum_j V_j p_j/sum_j V_j) at surfaces", "",
          fmt::format("p_mean {} Pa", medium.mean_pressure)};
}

}  // namespace toryu::fluid
