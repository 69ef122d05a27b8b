/// Friction of the abrasive (33): the fluid drags a work piece along as Coulomb's law has it. The force on
/// particle s of the work piece from particle f of the fluid, and its exact opposite on f, is
///
///     F_sf = mu_A V_f max(p_f, 0) d_s t_fs W_sf,   t_fs = v_fs/sqrt(v_fs^2 + eps^2),   v_fs = v_f - v_s
///
/// (sign and reaction mended: printed with one sign for both phases). d_s is a length:
///
///     as printed   d_s = d_0, for each particle of the work piece
///     normalised   d_s = |A_s|/sum_f V_f W_sf, A_s the lengths of its open faces across x and y (none
///     inside)
///
/// About an axis V_f and A_s are those of whole rings (ring_areas of terms/axisymmetry.hpp).
///
/// Normalised, a surface under the pressure p bears the traction mu_A p. As printed it bears mu_A p times a
/// sum of kernel values, `printed_share`: 0.16, 0.22, 0.25, 0.30 at h/d_0 = 1.0, 1.2, 1.3, 1.5.
/// eps regularises it: up to about that speed the friction is a linear drag, so that it has no direction to
/// jump to at rest. Its rate is mu_A p/(rho_0 d_0 eps), p the largest pressure of the fluid, and a step stays
/// below half of the time that it takes, so a small eps makes many steps; a fifth of the sliding speed still
/// transmits 98 %. v_fs is taken as it is, its part along the normal too.
///
/// Beside [fluid.wall_slip] the walls of work pieces bear it in their own shear stress, the smaller of mu_A p
/// and the slip law's, without eps (wall_slip.hpp).
///
/// mu_A p is what friction can transmit at most. Where the medium's shear stress is less, the row beside the
/// work piece sticks, as at a no-slip wall: in a throat of 9 mm, with a medium as thin as water (artificial
/// viscosity alpha = 0.05) under 400 Pa and mu_A = 0.3, the work piece bore 4 Pa of the possible 120; with
/// mu_A = 0.003 the medium slid.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "common/case/parameter_table.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/points.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

static_assert(dim == 2, "the share as printed is a sum over a lattice of the plane");

/// What the length d_s of (33) is: see terms/friction.hpp.
enum class FrictionForm { normalised, as_printed };
struct Friction {
  static constexpr const char* section = "friction";
  static constexpr const char* help = "of the abrasive on the work pieces (Kato's thesis)";
  double coefficient = 0.3;  ///< mu_A
  FrictionForm form = FrictionForm::normalised;
  double regularisation_speed = 0;  ///< [m/s]; 0: c_0/1000
};
inline void describe(ParameterTable& table, Friction& friction) {
  table.number("coefficient", friction.coefficient,
               {.minimum = 0, .required = true, .help = "mu_A, traction over pressure (Kato's thesis)"});
  table.choice(
      "form", friction.form, {"normalised", "as_printed"},
      {.help = "normalised: a plane interface transmits mu_A p; as_printed: with d_f = d_0, which "
               "transmits only about 0.22 mu_A p at h = 1.2 d_0 (0.16 at 1.0, 0.25 at 1.3, 0.30 at 1.5)"});
  table.number("regularisation_speed", friction.regularisation_speed,
               {.unit = "m/s",
                .minimum = 0,
                .help = "below about this sliding speed friction is a linear drag; 0: c_0/1000, with "
                        "[fluid.similarity] a twentieth of 'mean_speed'; not used beside [fluid.wall_slip]"});
}

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

/// eps, by default a thousandth of the sound speed [m/s].
inline double regularisation_speed(const Friction& friction, double c_0) {
  return friction.regularisation_speed > 0 ? friction.regularisation_speed : 1e-3 * c_0;
}

inline ActiveTerm text(const Friction& friction, const Medium& medium) {
  const double eps = regularisation_speed(friction, medium.c_0);
  const std::string transmitted =
      friction.form == FrictionForm::normalised
          ? "normalised: a plane interface transmits mu_A p"
          : fmt::format("as printed: a plane interface transmits only about {:.2f} mu_A p at h = {:.4g} d_0",
                        printed_share(medium.kernel, medium.d_0), medium.h() / medium.d_0);
  return {"friction", "F_s = mu_A sum_f V_f max(p_f, 0) d_s v_fs/sqrt(v_fs^2 + eps^2) W_sf",
          "Kato's thesis, eq. 33, mended",
          fmt::format("mu_A {}, eps {} m/s, {}", friction.coefficient, eps, transmitted)};
}

}  // namespace toryu::fluid
