/// Artificial stress against the tensile instability (Gray, Monaghan & Swift 2001; thesis eq. 25-26):
///
///     Dv_i/Dt += sum_j m_j (R_i + R_j) F_ij^n gradW_ij,   F_ij = W(r_ij)/W(d0)
///     R'_k = -epsilon sigma'_k/rho^2 where sigma'_k > 0, else 0
///
/// with sigma'_k the principal stresses, and R turned back from their frame. epsilon = 0.3, n = 4.
#pragma once

#include "common/case/parameter_table.hpp"
#include "solid_solver/terms/tensor.hpp"

namespace toryu {

struct ArtificialStress {
  double epsilon = 0.3;
  int exponent = 4;  ///< n
};
inline void describe(ParameterTable& table, ArtificialStress& p) {
  table.number("epsilon", p.epsilon,
               {.minimum = 0, .maximum = 1, .help = "share of a tensile principal stress"});
  table.integer("exponent", p.exponent, {.minimum = 1, .maximum = 10, .help = "n of F^n"});
}

/// R_i [m5/(kg s2)] of `sigma` [Pa]. The frame's angle a has tan 2a = 2 sigma_xy/(sigma_xx - sigma_yy), so
/// with D half the difference of the principal stresses cos 2a = (sigma_xx - sigma_yy)/(2 D) and
/// sin 2a = sigma_xy/D: no angle is needed.
inline Symmetric<Lanes> artificial_stress(const Symmetric<Lanes>& sigma, const Lanes& inverse_rho_squared,
                                          double epsilon) {
  const Lanes mean = 0.5 * (sigma.xx + sigma.yy), difference = 0.5 * (sigma.xx - sigma.yy);
  const Lanes D = square_root(difference * difference + sigma.xy * sigma.xy);
  const Lanes scale = -epsilon * inverse_rho_squared;
  const Lanes R_1 = scale * positive_part(mean + D), R_2 = scale * positive_part(mean - D);
  const Lanes R_mean = 0.5 * (R_1 + R_2);
  const Lanes R_over_D = 0.5 * (R_1 - R_2) * inverse(max(D, Lanes(1e-300)));
  return {R_mean + R_over_D * difference, R_mean - R_over_D * difference, R_over_D * sigma.xy};
}

}  // namespace toryu
