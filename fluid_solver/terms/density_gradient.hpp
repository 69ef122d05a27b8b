/// Renormalised density gradient (20)-(21) over fluid particles (Randles & Libersky 1996):
///
///     <grad rho>_i = L_i sum_j V_j (rho_j - rho_i) gradW_ij,   L_i = [sum_j V_j (x_j - x_i) (x) gradW_ij]^-1
///
/// Where L_i is near singular (few neighbours, one-sided) the gradient is left out, that is zero.
#pragma once

#include "common/sph/cluster_list.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

/// Smallest eigenvalue of L^-1 (1 in a full lattice, about 1/2 at a straight free surface) that is inverted.
inline constexpr double smallest_moment = 0.1;

inline VecLanes density_gradient(const Particles& f, const CubicSpline& kernel, std::size_t first,
                                 std::span<const std::uint32_t> neighbours) {
  static_assert(dim == 2, "the inverse below is written for two dimensions");
  const VecLanes x_i = load(f.x, first);
  const Lanes rho_i = load(f.rho, first);
  Lanes M_xx = 0.0, M_xy = 0.0, M_yy = 0.0;
  VecLanes b = zero_vector();
  for (const std::uint32_t j : neighbours) {
    const VecLanes x_ij{x_i[0] - f.x[0][j], x_i[1] - f.x[1][j]};
    const Lanes r2 = max(dot(x_ij, x_ij), 1e-300);
    const Lanes inverse_r = inverse_sqrt(r2);
    const Lanes V_G = f.V[j] * kernel.gradient_over_r(r2 * inverse_r, inverse_r);
    const VecLanes V_grad{V_G * x_ij[0], V_G * x_ij[1]};
    M_xx -= x_ij[0] * V_grad[0];
    M_xy -= x_ij[0] * V_grad[1];
    M_yy -= x_ij[1] * V_grad[1];
    const Lanes rho_ji = f.rho[j] - rho_i;
    for (int a = 0; a < dim; ++a) b[a] += rho_ji * V_grad[a];
  }
  const Lanes determinant = M_xx * M_yy - M_xy * M_xy, trace = M_xx + M_yy;
  // the smaller eigenvalue exceeds m where both do: det - m trace + m^2 > 0 and trace > 2 m
  const auto regular = (determinant - smallest_moment * trace + smallest_moment * smallest_moment > 0.0) &
                       (trace > 2.0 * smallest_moment);
  const Lanes share = select(regular, inverse(max(determinant, 1e-12)), 0.0);
  return {share * (M_yy * b[0] - M_xy * b[1]), share * (M_xx * b[1] - M_xy * b[0])};
}

}  // namespace toryu::fluid
