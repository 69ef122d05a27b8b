/// Compressible neo-Hookean solid (Simo & Pister 1984; Wriggers 2008, eq. 3.119), in plane strain:
///
///     psi = G/2 (I_1 - 3 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J),   I_1 = tr(F^T F), J = det F
///     P = G (F - F^-T) + lambda/2 (J^2 - 1) F^-T,   P_zz = lambda/2 (J^2 - 1)
///
/// For small strains Hooke's law with the same lambda and G. Unlike St. Venant-Kirchhoff it resists being
/// pressed to nothing; stretched, it is softer. For strains of some ten percent, rubber up to about 40 %.
#pragma once

#include "solid_solver/terms/deformation.hpp"

namespace toryu::solid {

struct NeoHookean {
  double lambda, G;  ///< Lame's constants [Pa]

  /// P of H.
  template <class T>
  Tensor<T> stress(const Tensor<T>& H) const {
    const T e = volume_change(H);
    const T inverse_J = 1.0 / (1.0 + e), pressure_part = 0.5 * lambda * e * (2.0 + e);
    const Tensor<T> shear = shear_part(H, e), cofactor = cofactors(H);
    Tensor<T> P;
    for (std::size_t n = 0; n < P.size(); ++n)
      P[n] = inverse_J * (G * shear[n] + pressure_part * cofactor[n]);
    return P;
  }
  double stress_across(const Tensor<double>& H) const {
    const double e = volume_change(H);
    return 0.5 * lambda * e * (2.0 + e);
  }
  double energy(const Tensor<double>& H) const {
    const double e = volume_change(H), log_J = std::log1p(e);
    return 0.5 * G * (first_invariant_change(H) - 2.0 * log_J) +
           0.25 * lambda * (e * (2.0 + e) - 2.0 * log_J);
  }
  template <class T>
  T longitudinal_modulus(const T& along_squared, const T& across_squared) const {
    return G * (1.0 + 1.0 / along_squared) + 0.5 * lambda * (across_squared + 1.0 / along_squared);
  }
};

}  // namespace toryu::solid
