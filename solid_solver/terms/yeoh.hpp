/// Rubber (Yeoh 1993), with the change of volume split off and the volumetric energy of Simo & Taylor (1982),
/// in plane strain:
///
///     psi = sum_k c_k0 (I - 3)^k + K/4 (J^2 - 1 - 2 ln J),   k = 1, 2, 3,   I = J^(-2/3) I_1, I_1 = tr(F^T
///     F) P = 2 psi' J^(-2/3) (F - I_1/3 F^-T) + K/2 (J^2 - 1) F^-T,   psi' = c_10 + 2 c_20 (I-3) + 3 c_30
///     (I-3)^2
///
/// For small strains Hooke's law with G = 2 c_10 and the bulk modulus K. Filled rubber has c_20 < 0 < c_30:
/// the modulus falls with the strain and rises again when the chains are drawn out. c_20 = c_30 = 0 is the
/// neo-Hookean solid with the split. Rubber's own K (about 2 GPa) makes the steps short and the body stiffer
/// than it is for few rows; K of 20 to 100 c_10 is usual, to be checked by another.
#pragma once

#include "common/case/parameter_table.hpp"
#include "solid_solver/material.hpp"
#include "solid_solver/terms/deformation.hpp"

namespace toryu {

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

  /// What it is for small strains.
  ElasticMaterial small_strain(double density) const {
    const double K = bulk_modulus, G = 2.0 * c_10;
    return {density, 9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G))};
  }
  /// d psi/dI at I - 3 = `change`.
  template <class T>
  T slope(const T& change) const {
    return c_10 + change * (2.0 * c_20 + 3.0 * c_30 * change);
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
    return change * (c_10 + change * (c_20 + change * c_30)) +
           0.25 * bulk_modulus * (e * (2.0 + e) - 2.0 * log_J);
  }
  template <class T>
  T longitudinal_modulus(const T& along_squared, const T& across_squared) const {
    const T J_squared = along_squared * across_squared, factor = isochoric_factor(square_root(J_squared));
    const T I_1 = along_squared + across_squared + 1.0, change = factor * I_1 - 3.0;
    const T shear = along_squared - I_1 * (1.0 / 3.0);
    const T first = 4.0 * factor * factor * shear * shear;  // (dI/dl)^2 l^2
    const T second = factor * (4.0 * along_squared + 10.0 * (across_squared + 1.0)) * (1.0 / 9.0);
    return ((2.0 * c_20 + 6.0 * c_30 * change) * first + slope(change) * second +
            0.5 * bulk_modulus * (J_squared + 1.0)) /
           along_squared;
  }
};
inline void describe(ParameterTable& table, Yeoh& p) {
  table.number("c_10", p.c_10,
               {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = true, .help = "half of G"});
  table.number("c_20", p.c_20, {.unit = "Pa", .help = "negative where the modulus falls with the strain"});
  table.number("c_30", p.c_30, {.unit = "Pa", .minimum = 0, .help = "drawn-out chains"});
  table.number("bulk_modulus", p.bulk_modulus,
               {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = true, .help = "K"});
  table.require(p.c_20 >= 0 || p.c_20 * p.c_20 < 3.0 * p.c_10 * p.c_30, "c_20",
                "'c_20' in [solid.yeoh] must be above -sqrt(3 c_10 c_30): below it the rubber gives way");
}

}  // namespace toryu
