/// Pressure part of the momentum equation (22): - sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) gradW_ij.
#pragma once

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct Pressure {
  TORYU_INLINE void momentum(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                             Rates& rates) const {
    const Lanes factor = (-source.m[j] * (i.p_rho2 + source.p_rho2[j])) * pair.G;
    for (int a = 0; a < dim; ++a) rates.a[a] += factor * pair.x_ij[a];
  }
};

}  // namespace toryu::fluid
