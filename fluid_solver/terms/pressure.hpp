/// Pressure part of the momentum equation (22): - sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) gradW_ij.
///
/// Where a wall does not hold the fluid by suction, a pair of both counts only while its sum is positive: a
/// wall pushes and never pulls. A jet that leaves an edge then parts from it, as water does where air can
/// follow; held, it is turned around the edge by a pressure far below zero. Others set the negative pressure
/// of wall particles to zero (TrixiParticles.jl does by default): that halves the pull and leaves the rest.
#pragma once

#include <limits>

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct Pressure {
  double least_at_wall;  ///< of p_i/rho_i^2 + p_w/rho_w^2 [m5/(kg s2)]

  explicit Pressure(bool suction = true)
      : least_at_wall(suction ? -std::numeric_limits<double>::infinity() : 0.0) {}

  TORYU_INLINE void momentum(const Targets& i, const Sources& source, std::size_t j, const Pair&,
                             Rates& rates) const {
    rates.push += i.p_rho2 + source.p_rho2[j];
  }
  /// Instead of that between the fluid and a wall, on either side.
  TORYU_INLINE void at_wall(const Targets& i, const Sources& source, std::size_t j, const Pair&,
                            Rates& rates) const {
    rates.push += max(i.p_rho2 + source.p_rho2[j], least_at_wall);
  }
};

}  // namespace toryu::fluid
