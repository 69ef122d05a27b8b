/// Continuity, (18) first sum: Drho_i/Dt = rho_i sum_j V_j v_ij . gradW_ij. At walls v_j is the wall's own.
#pragma once

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct Continuity {
  TORYU_INLINE void density(const Targets&, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    rates.compression += (source.V[j] * dot(pair.v_ij, pair.x_ij)) * pair.G;
  }
};

}  // namespace toryu::fluid
