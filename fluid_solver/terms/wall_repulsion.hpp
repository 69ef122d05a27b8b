/// Short repulsion of walls, in the manner of the boundary forces of Monaghan & Kajtar (2009): a pair force
/// that is felt nearer than r_0 = `range` d_0 alone,
///
///     F_iw = m_i m_w/(rho_0 d_0^2) B c_0^2/d_0 (1 - r_iw/r_0) x_iw/r_iw,   r_iw < r_0
///
/// equal and opposite, and of a potential, so it takes no energy. A flat wall keeps the fluid off by its
/// pressure (29); at the sharp corner of a work piece that is a mean over both sides, and a particle that is
/// driven past it cuts the corner by some hundredths of a spacing. The corner lies 0.71 d_0 from the nearest
/// wall particle, and r_0 = 0.8 d_0 is felt just there.
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

/// Keeps particles from cutting the corners of walls, see terms/wall_repulsion.hpp.
struct WallRepulsion {
  static constexpr const char* section = "wall_repulsion";
  static constexpr const char* help = "keeps particles off the sharp corners of walls";
  double strength = 1.0;  ///< B
  double range = 0.8;     ///< r_0/d_0
};
inline void describe(ParameterTable& table, WallRepulsion& repulsion) {
  table.number(
      "strength", repulsion.strength,
      {.minimum = 0, .maximum = 10, .help = "B, of the order of 1: the stiffness of the fluid itself"});
  table.number(
      "range", repulsion.range,
      {.minimum = 0.1, .maximum = 1.0, .help = "r_0/d_0 below which it is felt; a corner lies 0.71 away"});
}

struct WallRepulsionTerm {
  double factor;         ///< B c_0^2/(rho_0 d_0^3) [m2/(kg s2)]
  double inverse_range;  ///< 1/r_0 [1/m]

  /// Between the fluid and a wall only.
  TORYU_INLINE void at_wall(const Targets&, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    const Lanes inverse_r = inverse_sqrt(pair.r2);
    const Lanes push = (factor * source.m[j]) * positive_part(inverse_r - inverse_range);
    for (int a = 0; a < dim; ++a) rates.a[a] += push * pair.x_ij[a];
  }
};

inline ActiveTerm text(const WallRepulsion& repulsion, const Medium&) {
  return {"wall repulsion", "m_i m_w/(rho_0 d_0^2) B c_0^2/d_0 (1 - r/r_0), r < r_0",
          "in the manner of Monaghan & Kajtar 2009",
          fmt::format("B {}, r_0 {} d_0", repulsion.strength, repulsion.range)};
}

}  // namespace toryu::fluid
