/// What a case says of particle shifting; weakly_compressible/shifting.hpp has the formula.
#pragma once

#include <fmt/format.h>

#include <optional>

#include "common/case/parameter_table.hpp"
#include "common/vector.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// Spreads the particles evenly, see shifting.hpp.
struct ParticleShifting {
  static constexpr const char* section = "particle_shifting";
  static constexpr const char* help = "spreads particles evenly (Sun et al. 2017)";
  double strength = 2.0;  ///< A
};
inline void describe(ParameterTable& table, ParticleShifting& shifting) {
  table.number(
      "strength", shifting.strength,
      {.minimum = 0, .maximum = 10, .help = "A of the shift -A h u_max dt grad C; Sun et al. 2017 take 2"});
}

inline ActiveTerm text(const ParticleShifting& shifting, const Medium&) {
  return {"particle shifting", "-A h u_max dt sum_j V_j [1 + R (W_ij/W(d_0))^4] gradW_ij",
          "Lind et al. 2012, Sun et al. 2017", fmt::format("A {}", shifting.strength)};
}

}  // namespace toryu::fluid
