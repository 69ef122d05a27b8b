/// What the laws of the total Lagrangian form need of a displacement gradient H = F - I, in plane strain. No
/// differences of large numbers: small strains keep their digits.
#pragma once

#include <cmath>

#include "common/sph/tensor.hpp"
#include "common/vector.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the laws are those of plane strain");

/// Change of volume J - 1, J = det F.
template <class T>
T volume_change(const Tensor<T>& H) {
  return H[0] + H[3] + H[0] * H[3] - H[1] * H[2];
}

/// I_1 - 3 = tr(F^T F) - 3, the third principal stretch being 1.
template <class T>
T first_invariant_change(const Tensor<T>& H) {
  return 2.0 * (H[0] + H[3]) + H[0] * H[0] + H[1] * H[1] + H[2] * H[2] + H[3] * H[3];
}

/// J F^-T, the cofactors of F.
template <class T>
Tensor<T> cofactors(const Tensor<T>& H) {
  return {1.0 + H[3], -H[2], -H[1], 1.0 + H[0]};
}

/// J (F - F^-T), with e = J - 1.
template <class T>
Tensor<T> shear_part(const Tensor<T>& H, const T& e) {
  return {H[0] - H[3] + (1.0 + H[0]) * e, H[1] * (1.0 + e) + H[2], H[2] * (1.0 + e) + H[1],
          H[3] - H[0] + (1.0 + H[3]) * e};
}

/// E = (F^T F - I)/2.
template <class T>
Symmetric<T> green_lagrange_strain(const Tensor<T>& H) {
  return {H[0] + 0.5 * (H[0] * H[0] + H[2] * H[2]), H[3] + 0.5 * (H[1] * H[1] + H[3] * H[3]),
          0.5 * (H[1] + H[2] + H[0] * H[1] + H[2] * H[3])};
}

inline double square_root(double a) {
  return std::sqrt(a);
}

/// Squares of the principal stretches in the plane.
template <class T>
struct PrincipalStretches {
  T larger_squared, smaller_squared;
};
template <class T>
PrincipalStretches<T> principal_stretches(const Tensor<T>& H) {
  const Symmetric<T> E = green_lagrange_strain(H);
  const T mean = E.xx + E.yy, difference = E.xx - E.yy;
  const T spread = square_root(T(difference * difference + 4.0 * E.xy * E.xy));
  return {1.0 + mean + spread, 1.0 + mean - spread};
}

}  // namespace toryu::solid
