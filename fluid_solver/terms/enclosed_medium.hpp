/// The mean pressure of a medium that is enclosed on all sides. Only differences of pressure move such a
/// medium; how high it stands as a whole is what the press sets, and what the few thousandths of compression
/// in the particles' order make of it is an accident. So the pressure that does something at a surface is
///
///     p_i + (p_mean - sum_j V_j p_j/sum_j V_j),
///
/// in contact, friction (33), removal, observers and frames; the sums of the momentum keep p_i. Where pistons
/// are pressed, it is p_i + q: they press with their pressure less
///
///     q = (p_most + p_least)/2 - p_b,
///
/// of the largest and the least of them, so that the medium keeps its rest density whatever the machine's
/// pressure (held_pressure.hpp).
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

struct EnclosedMedium {
  static constexpr const char* section = "enclosed_medium";
  static constexpr const char* help = "the pressure at which a press holds a medium without free surface";
  double mean_pressure = 0;  ///< [Pa]; 0: as pressed walls set it
};
inline void describe(ParameterTable& table, EnclosedMedium& medium) {
  table.number("mean_pressure", medium.mean_pressure,
               {.unit = "Pa",
                .minimum = 0,
                .help = "over the volume: what contact, friction, removal and the results have; the motion "
                        "does not depend on it; 0: as walls with a 'press' set it"});
}

inline ActiveTerm text(const EnclosedMedium& medium, const Medium&) {
  if (medium.mean_pressure == 0)
    return {"enclosed medium", "p_i + (p_most + p_least)/2 - p_b at surfaces", "", "by pressed walls"};
  return {"enclosed medium", "p_i + (p_mean - sum_j V_j p_j/sum_j V_j) at surfaces", "",
          fmt::format("p_mean {} Pa", medium.mean_pressure)};
}

}  // namespace toryu::fluid
