/// Rubber (Yeoh 1993), with the change of volume split off and the volumetric energy of Simo & Taylor (1982),
/// in plane strain:
///
///     psi = sum_k c_k0 (I - 3)^k + alpha/beta (1 - exp(-beta (I - 3))) + K/4 (J^2 - 1 - 2 ln J)
///     P = 2 psi' J^(-2/3) (F - I_1/3 F^-T) + K/2 (J^2 - 1) F^-T
///     psi' = c_10 + 2 c_20 (I - 3) + 3 c_30 (I - 3)^2 + alpha exp(-beta (I - 3))
///
/// with k = 1, 2, 3, I = J^(-2/3) I_1 and I_1 = tr(F^T F).
///
/// For small strains Hooke's law with G = 2 (c_10 + alpha) and the bulk modulus K. Filled rubber has
/// c_20 < 0 < c_30: the modulus falls with the strain and rises again when the chains are drawn out; alpha is
/// what its filler adds as long as I - 3, the square of a shear strain, is below about 1/beta. c_10 alone is
/// the neo-Hookean solid with the split. Rubber's own K (about 2 GPa) makes the steps short and the body
/// stiffer than it is for few rows; K of 20 to 100 c_10 is usual, to be checked by another.
#pragma once

#include "common/case/parameter_table.hpp"
#include "solid_solver/material.hpp"
#include "solid_solver/terms/deformation.hpp"

namespace toryu::solid {

/// e^a.
inline double exponential(double a) {
  return std::exp(a);
}
inline Lanes exponential(Lanes a) {
  for (std::size_t lane = 0; lane < lane_count; ++lane) a.value[lane] = std::exp(a[lane]);
  return a;
}

/// J^(-2/3).
inline double isochoric_factor(double J) {
  const double root = std::cbrt(J);
  return 1.0 / (root * root);
}
inline Lanes isochoric_factor(Lanes J) {
  for (std::size_t lane = 0; lane < lane_count; ++lane) J.value[lane] = isochoric_factor(J[lane]);
  return J;
}

struct Yeoh {
  double c_10 = 0, c_20 = 0, c_30 = 0;  ///< [Pa]
  double bulk_modulus = 0;              ///< [Pa]
  double alpha = 0;                     ///< [Pa]
  double beta = 0;

  /// What it is for small strains.
  ElasticMaterial small_strain(double density) const {
    const double K = bulk_modulus, G = 2.0 * (c_10 + alpha);
    return {density, 9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G))};
  }
  /// d psi/dI at I - 3 = `change`.
  template <class T>
  T slope(const T& change) const {
    const T chains = c_10 + change * (2.0 * c_20 + 3.0 * c_30 * change);
    return alpha > 0 ? T(chains + alpha * exponential(T(-beta * change))) : chains;
  }
  /// d^2 psi/dI^2 there.
  template <class T>
  T curvature(const T& change) const {
    const T chains = 2.0 * c_20 + 6.0 * c_30 * change;
    return alpha > 0 ? T(chains - alpha * beta * exponential(T(-beta * change))) : chains;
  }
  /// P of H.
  template <class T>
  Tensor<T> stress(const Tensor<T>& H) const {
    const T e = volume_change(H), I_1 = 3.0 + first_invariant_change(H);
    const T inverse_J = 1.0 / (1.0 + e), factor = isochoric_factor(T(1.0 + e));
    const T shear_modulus = 2.0 * slope(T(factor * I_1 - 3.0)) * factor;
    const T along_cofactor = 0.5 * bulk_modulus * e * (2.0 + e) - shear_modulus * (I_1 * (1.0 / 3.0) - 1.0);
    const Tensor<T> shear = shear_part(H, e), cofactor = cofactors(H);
    Tensor<T> P;
    for (std::size_t n = 0; n < P.size(); ++n)
      P[n] = inverse_J * (shear_modulus * shear[n] + along_cofactor * cofactor[n]);
    return P;
  }
  double stress_across(const Tensor<double>& H) const {
    const double e = volume_change(H), t = first_invariant_change(H), factor = isochoric_factor(1.0 + e);
    return 0.5 * bulk_modulus * e * (2.0 + e) - 2.0 / 3.0 * slope(factor * (3.0 + t) - 3.0) * factor * t;
  }
  double energy(const Tensor<double>& H) const {
    const double e = volume_change(H), log_J = std::log1p(e), factor_change = std::expm1(-2.0 / 3.0 * log_J);
    const double t = first_invariant_change(H), change = 3.0 * factor_change + t + factor_change * t;
    const double filler = alpha > 0 ? -alpha / beta * std::expm1(-beta * change) : 0.0;
    return change * (c_10 + change * (c_20 + change * c_30)) + filler +
           0.25 * bulk_modulus * (e * (2.0 + e) - 2.0 * log_J);
  }
  template <class T>
  T longitudinal_modulus(const T& along_squared, const T& across_squared) const {
    const T J_squared = along_squared * across_squared, factor = isochoric_factor(square_root(J_squared));
    const T I_1 = along_squared + across_squared + 1.0, change = factor * I_1 - 3.0;
    const T shear = along_squared - I_1 * (1.0 / 3.0);
    const T first = 4.0 * factor * factor * shear * shear;  // (dI/dl)^2 l^2
    const T second = factor * (4.0 * along_squared + 10.0 * (across_squared + 1.0)) * (1.0 / 9.0);
    return (curvature(change) * first + slope(change) * second + 0.5 * bulk_modulus * (J_squared + 1.0)) /
           along_squared;
  }
};
inline void describe(ParameterTable& table, Yeoh& p) {
  table.number(
      "c_10", p.c_10,
      {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = true, .help = "half of G, less alpha"});
  table.number("c_20", p.c_20, {.unit = "Pa", .help = "negative where the modulus falls with the strain"});
  table.number("c_30", p.c_30, {.unit = "Pa", .minimum = 0, .help = "drawn-out chains"});
  table.number("bulk_modulus", p.bulk_modulus,
               {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = true, .help = "K"});
  table.number("alpha", p.alpha, {.unit = "Pa", .minimum = 0, .help = "what a filler adds to c_10 at rest"});
  table.number("beta", p.beta, {.minimum = 0, .help = "its decay with the square of the shear strain"});
  table.require(p.alpha == 0 || p.beta > 0, "beta",
                "'beta' in [solid.yeoh] must be above 0 where there is an 'alpha'");
  // In shear, 2 psi' + 4 psi'' (I - 3) > 0; what alpha gives has its minimum at beta (I - 3) = 3/2.
  table.require(p.c_10 > 2.0 * std::exp(-1.5) * p.alpha, "alpha",
                "'alpha' in [solid.yeoh] must be below 2.24 c_10: above it the rubber gives way");
  table.require(p.c_20 >= 0 || p.c_20 * p.c_20 < 3.0 * p.c_10 * p.c_30, "c_20",
                "'c_20' in [solid.yeoh] must be above -sqrt(3 c_10 c_30): below it the rubber gives way");
}

}  // namespace toryu::solid
