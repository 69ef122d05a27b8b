/// Artificial stress against the tensile instability (Gray, Monaghan & Swift 2001; thesis eq. 25-26):
///
///     Dv_i/Dt += sum_j m_j (R_i + R_j) F_ij^n gradW_ij,   F_ij = W(r_ij)/W(d0)
///     R'_k = -epsilon sigma'_k/rho^2 where sigma'_k > 0, else 0
///
/// with sigma'_k the principal stresses, and R turned back from their frame. epsilon = 0.3, n = 4.
///
/// What it must outweigh: under a tension sigma the columns of a lattice that move to and fro against their
/// neighbours have no gradient in the sums, so no elastic force; the tension itself drives them by
///
///     Dv_i/Dt = 4 sigma/rho u_i sum_j V [d2W/dx2 - epsilon d/dx (F^n dW/dx)],   j in the columns at odd
///     distance
///
/// (after Monaghan 2000, who has all wave lengths of a row). Measured: cases/stretched_bar/tensile_map.toml.
///
/// It feeds another mode, of rows that slide and carry little stress. epsilon = 0.3 is at the edge: 4 rows
/// rest, 8 rows with h = 1.25 d0 slide into another arrangement, strained by 1.3 %, under no load to speak
/// of; at 0.5 by 12 %. Without viscosity it tears any body; alpha of 0.02 and more stops that
/// (cases/abrasive_flow/README.md, "Does the surface peel?").
#pragma once

#include <cmath>

#include "common/case/parameter_table.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/tensor.hpp"
#include "common/vector.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the principal stresses are those of the plane");

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

/// Least epsilon at which the sum above is not positive, for a square lattice of h/d0 = `smoothing_ratio`,
/// which is stretched by `strain` along x and free to contract with Poisson's ratio 0.4 in plane strain.
inline double least_epsilon(double smoothing_ratio, int exponent, double strain = 0.02) {
  const CubicSpline W(smoothing_ratio);
  const double W_d0 = W.value(1.0), step = 1e-5, contraction = 0.4 / 0.6 * strain;
  double plain = 0, weighted = 0;  // sums of d2W/dx2 and of d/dx (F^n dW/dx)
  for (const int a : {-3, -1, 1, 3})
    for (int b = -3; b <= 3; ++b)
      for (const double side : {-1.0, 1.0}) {
        const double x = (1 + strain) * a + side * step, r = std::hypot(x, (1 - contraction) * b);
        const double slope = side * W.gradient_over_r(r, 1.0 / r) * x / (2.0 * step);
        plain += slope;
        weighted += slope * std::pow(W.value(r) / W_d0, exponent);
      }
  return std::max(0.0, plain / weighted);
}

}  // namespace toryu::solid
