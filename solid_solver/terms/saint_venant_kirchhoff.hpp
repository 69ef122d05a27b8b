/// St. Venant-Kirchhoff: stress in proportion to the Green-Lagrange strain, in plane strain,
///
///     E = (F^T F - I)/2,   S = lambda tr(E) I + 2 G E,   P = F S,   sigma = F S F^T/det F
///     energy per reference volume psi = lambda/2 tr(E)^2 + G E:E,   S_zz = lambda tr(E)
///
/// F = I + H is the deformation gradient, P the first Piola-Kirchhoff stress [Pa].
#pragma once

#include "solid_solver/terms/tensor.hpp"

namespace toryu {

/// Green-Lagrange strain of the displacement gradient H: no difference of large numbers.
template <class T>
Symmetric<T> green_lagrange_strain(const Tensor<T>& H) {
  return {H[0] + 0.5 * (H[0] * H[0] + H[2] * H[2]), H[3] + 0.5 * (H[1] * H[1] + H[3] * H[3]),
          0.5 * (H[1] + H[2] + H[0] * H[1] + H[2] * H[3])};
}

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
  double energy(const Symmetric<double>& E) const {
    const double trace = E.xx + E.yy;
    return 0.5 * lambda * trace * trace + G * (E.xx * E.xx + E.yy * E.yy + 2.0 * E.xy * E.xy);
  }
};

}  // namespace toryu
