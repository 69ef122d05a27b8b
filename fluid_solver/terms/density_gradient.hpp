/// Renormalised density gradient (20)-(21) over fluid particles (Randles & Libersky 1996):
///
///     <grad rho>_i = L_i sum_j V_j (rho_j - rho_i) gradW_ij
///
/// Where L_i is near singular (few neighbours, one-sided) the gradient is left out, that is zero.
#pragma once

#include "common/sph/neighbour_loop.hpp"
#include "common/sph/renormalisation.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

template <class W>
VecLanes density_gradient(const Particles& f, const W& kernel, std::size_t first,
                          std::span<const ShiftedNeighbours> neighbours) {
  const Lanes rho_i = load(f.rho, first);
  Moment moment;
  VecLanes b = zero_vector();
  over_neighbours(kernel, neighbours, load(f.x, first), pointers(f.x),
                  [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const VecLanes V_grad = n.gradient(f.V[j]);
                    moment.add(n.x_ij, V_grad);
                    add_product(b, f.rho[j] - rho_i, V_grad);
                  });
  moment.invert();
  return moment.renormalised(b);
}

}  // namespace toryu::fluid
