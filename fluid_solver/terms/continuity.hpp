/// Continuity, (18) first sum: Drho_i/Dt = rho_i sum_j V_j v_ij . gradW_ij. At walls v_j is the wall's own.
///
/// Where a wall does not hold the fluid by suction (`pressure.hpp`), a pair of both that pulls does not thin
/// the fluid either: what parts is filled by air. A drop that leaves the floor would come away at half its
/// density.
#pragma once

#include <limits>

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct Continuity {
  double least_at_wall;  ///< of p_i/rho_i^2 + p_w/rho_w^2 [m5/(kg s2)]

  explicit Continuity(bool suction = true)
      : least_at_wall(suction ? -std::numeric_limits<double>::infinity() : 0.0) {}

  TORYU_INLINE void density(const Targets&, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    rates.compression += compression(source, j, pair);
  }
  /// Instead of that between the fluid and a wall.
  TORYU_INLINE void density_at_wall(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                                    Rates& rates) const {
    const Lanes all = compression(source, j, pair);
    rates.compression += select(i.p_rho2 + source.p_rho2[j] >= least_at_wall, all, positive_part(all));
  }

 private:
  TORYU_INLINE static Lanes compression(const Sources& source, std::size_t j, const Pair& pair) {
    return (source.V[j] * dot(pair.v_ij, pair.x_ij)) * pair.G;
  }
};

}  // namespace toryu::fluid
