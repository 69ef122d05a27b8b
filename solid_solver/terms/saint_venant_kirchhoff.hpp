/// St. Venant-Kirchhoff: stress in proportion to the Green-Lagrange strain, in plane strain,
///
///     E = (F^T F - I)/2,   S = lambda tr(E) I + 2 G E,   P = F S,   sigma = F S F^T/det F
///     energy per reference volume psi = lambda/2 tr(E)^2 + G E:E,   S_zz = lambda tr(E)
///
/// F = I + H is the deformation gradient, P the first Piola-Kirchhoff stress [Pa]. It stiffens in tension and
/// softens in compression: pressed to 1/sqrt(3) of its length a bar gives way. For small strains and any
/// rotation.
#pragma once

#include "solid_solver/terms/deformation.hpp"

namespace toryu::solid {

struct SaintVenantKirchhoff {
  double lambda, G;  ///< Lame's constants [Pa]

  template <class T>
  Symmetric<T> second_piola_kirchhoff(const Symmetric<T>& E) const {
    const T pressure_part = lambda * (E.xx + E.yy);
    return {pressure_part + 2.0 * G * E.xx, pressure_part + 2.0 * G * E.yy, 2.0 * G * E.xy};
  }
  /// P of H.
  template <class T>
  Tensor<T> stress(const Tensor<T>& H) const {
    const Tensor<T> S = second_piola_kirchhoff(green_lagrange_strain(H)).full();
    return product({1.0 + H[0], H[1], H[2], 1.0 + H[3]}, S);
  }
  double stress_across(const Tensor<double>& H) const {
    const Symmetric<double> E = green_lagrange_strain(H);
    return lambda * (E.xx + E.yy);
  }
  double energy(const Tensor<double>& H) const {
    const Symmetric<double> E = green_lagrange_strain(H);
    const double trace = E.xx + E.yy;
    return 0.5 * lambda * trace * trace + G * (E.xx * E.xx + E.yy * E.yy + 2.0 * E.xy * E.xy);
  }
  template <class T>
  T longitudinal_modulus(const T& along_squared, const T& across_squared) const {
    return (lambda + 2.0 * G) * (1.5 * along_squared - 0.5) + 0.5 * lambda * (across_squared - 1.0);
  }
};

}  // namespace toryu::solid
