/// Friction of the abrasive (33): the fluid drags a work piece along as Coulomb's law has it. The force on
/// particle s of the work piece from particle f of the fluid, and its exact opposite on f, is
///
///     F_sf = mu_A V_f max(p_f, 0) d_s t_fs W_sf,   t_fs = v_fs/sqrt(v_fs^2 + eps^2),   v_fs = v_f - v_s
///
/// (sign and reaction mended: printed with one sign for both phases). d_s is a length:
///
///     as printed   d_s = d_0, for each particle of the work piece
///     normalised   d_s = |A_s|/sum_f V_f W_sf, A_s the particle's area vector (none inside)
///
/// Normalised, a surface under the pressure p bears the traction mu_A p. As printed it bears mu_A p times a
/// sum of kernel values, `printed_share`: 0.16, 0.22, 0.25, 0.30 at h/d_0 = 1.0, 1.2, 1.3, 1.5.
/// eps regularises it: up to about that speed the friction is a linear drag, so that it has no direction to
/// jump to at rest. Its rate is mu_A p/(rho_0 d_0 eps), p the largest pressure of the fluid, and a step stays
/// below half of the time that it takes, so a small eps makes many steps; a fifth of the sliding speed still
/// transmits 98 %. v_fs is taken as it is, its part along the normal too.
///
/// mu_A p is what friction can transmit at most. Where the medium's shear stress is less, the row beside the
/// work piece sticks, as at a no-slip wall: in a throat of 9 mm, with a medium as thin as water (artificial
/// viscosity alpha = 0.05) under 400 Pa and mu_A = 0.3, the work piece bore 4 Pa of the possible 120; with
/// mu_A = 0.003 the medium slid.
#pragma once

#include <cmath>

#include "common/sph/kernel.hpp"
#include "common/sph/points.hpp"

namespace toryu::fluid {

struct FrictionTerm {
  double mu_A;
  double eps;  ///< [m/s]

  /// F_sf/V_f [N/m3] for W_sf at distance `r`; what belongs to s or f may be lanes or numbers.
  template <class W>
  TORYU_INLINE VecLanes per_volume(const W& kernel, Lanes d_s, Lanes p_f, Lanes r,
                                   const VecLanes& v_fs) const {
    const Lanes t = inverse_sqrt(dot(v_fs, v_fs) + eps * eps);
    const Lanes factor = mu_A * positive_part(p_f) * d_s * kernel.value(r) * t;
    VecLanes force;
    for (int a = 0; a < dim; ++a) force[a] = factor * v_fs[a];
    return force;
  }
};

/// Below this sum_f V_f W_sf, a tenth of a plane interface's, the fluid is parting from the surface. The
/// normalised force then fades with the kernel, where it would else go on undiminished up to 2h and end
/// there.
inline constexpr double least_contact = 0.02;

/// The share of mu_A p that friction as printed transmits at a plane interface, by sums over a square lattice
/// on both sides, d_0 = `spacing`.
inline double printed_share(const Kernel& kernel, double spacing) {
  const int reach = static_cast<int>(kernel.support() / spacing) + 1;
  double sum = 0;
  for (int depth = 0; depth < reach; ++depth)  // row of the work piece
    for (int row = 1 + depth; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column)
        sum += kernel.value(spacing * std::hypot(row, column));
  return spacing * spacing * sum;
}

}  // namespace toryu::fluid
