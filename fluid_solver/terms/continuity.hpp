/// Continuity, (18) first sum: Drho_i/Dt = rho_i sum_j V_j v_ij . gradW_ij. At walls v_j is the wall's own.
///
/// A wall without suction (`pressure.hpp`) thins the fluid to 0.95 of its rest density and no further: what
/// parts is filled by air, and a drop that leaves the floor would come away at half its density. So far it
/// does thin, for coming back compresses: else water that a wall shakes rises, by two spacings in ten
/// seconds.
#pragma once

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct Continuity {
  double least_at_wall;  ///< density below which walls thin no more [kg/m3]

  explicit Continuity(double rest_density = 0, bool suction = true)
      : least_at_wall(suction ? 0.0 : (1 - most_thinned) * rest_density) {}

  static constexpr double most_thinned = 0.05;  ///< layers of water that part have thinned by less

  TORYU_INLINE void density(const Targets&, const Sources&, std::size_t, const Pair& pair,
                            Rates& rates) const {
    rates.compression += compression(pair);
  }
  /// Instead of that between the fluid and a wall.
  TORYU_INLINE void density_at_wall(const Targets& i, const Sources&, std::size_t, const Pair& pair,
                                    Rates& rates) const {
    const Lanes all = compression(pair);
    rates.compression += select(i.rho >= least_at_wall, all, positive_part(all));
  }

 private:
  TORYU_INLINE static Lanes compression(const Pair& pair) { return pair.V_G * dot(pair.v_ij, pair.x_ij); }
};

}  // namespace toryu::fluid
