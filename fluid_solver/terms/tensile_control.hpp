/// Tensile-instability control (Sun, Colagrossi, Marrone, Antuono & Zhang 2018): under suction, and away from
/// free surfaces and walls, the pressure force on i is that of the differences,
///
///     - sum_j m_j (p_j/rho_j^2 + s_i p_i/rho_i^2) gradW_ij,   s_i = -1 where p_i < 0 inside the fluid, else
///     1
///
/// for neighbours j. Both signs are the same gradient where particles lie evenly; but with s_i = 1 a
/// negative p_i draws neighbours together until they pair, with s_i = -1 it does not. Momentum between
/// particles is kept only as far as they lie evenly; so walls, whose loads are counted, must have s_i = 1,
/// and then the fluid near them too: a sum with two signs is no gradient (in cases/retreating_piston it tore
/// the medium at once).
///
/// Artificial pressure (Monaghan 2000) keeps momentum, but its repulsion is a pressure of its own, a tenth of
/// the suction; it is not offered.
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "common/sph/lanes.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// Keeps particles from pairing under suction, see terms/tensile_control.hpp.
struct TensileControl {
  static constexpr const char* section = "tensile_control";
  static constexpr const char* help = "no pairing under suction (Sun et al. 2018)";
};
inline void describe(ParameterTable&, TensileControl&) {}

/// s_i p_i/rho_i^2 from p_i/rho_i^2.
TORYU_INLINE Lanes without_tension(Lanes p_rho2, Lanes deep) {
  return select((p_rho2 < 0.0) & (deep > 0.0), -p_rho2, p_rho2);
}

inline ActiveTerm text(const TensileControl&, const Medium&) {
  return {"tensile control", "p_j/rho_j^2 - p_i/rho_i^2 where p_i < 0 inside the fluid", "Sun et al. 2018",
          ""};
}

}  // namespace toryu::fluid
