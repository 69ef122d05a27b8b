/// Renormalised density gradient (20)-(21) over fluid particles (Randles & Libersky 1996):
///
///     <grad rho>_i = L_i sum_j V_j (rho_j - rho_i) gradW_ij
///
/// Where L_i is near singular (few neighbours, one-sided) the gradient is left out, that is zero.
#pragma once

#include "fluid_solver/terms/neighbour_sum.hpp"
#include "fluid_solver/terms/renormalisation.hpp"

namespace toryu::fluid {

template <class W>
VecLanes density_gradient(const Particles& f, const W& kernel, std::size_t first,
                          std::span<const ShiftedNeighbours> neighbours) {
  const Lanes rho_i = load(f.rho, first);
  Moment moment;
  VecLanes b = zero_vector();
  over_neighbours(kernel, neighbours, load(f.x, first), sources(f),
                  [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    moment.add(n.x_ij, n.V_grad);
                    add_product(b, f.rho[j] - rho_i, n.V_grad);
                  });
  moment.invert();
  return moment.renormalised(b);
}

}  // namespace toryu::fluid
