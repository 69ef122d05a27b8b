/// Finds the particles that have no free surface and no wall in reach (Marrone, Colagrossi, Le Touze &
/// Graziani 2010): the moment of the neighbours, sum_j V_j (x_j - x_i) (x) gradW_ij, walls among them, has
/// the eigenvalues 1 in a full lattice and about 1/2 across a straight surface. Where the smaller one is
/// below `surface_moment` the particle is at a surface; who has such a neighbour within the kernel's support
/// has a surface in reach.
#pragma once

#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

inline constexpr double surface_moment = 0.75;

class FreeSurface {
 public:
  /// Fills `fluid.off_surface`.
  void find_off_surface(Particles& fluid, const ClusterList& neighbours,
                        const std::vector<Boundary>& boundaries, const Kernel& kernel);

 private:
  Field at_surface_;  ///< 1 for a particle at the surface, else 0; kept from step to step for its memory
};

/// Whether all of the fluid is `fluid.off_surface`.
bool is_closed(const Particles& fluid);

/// Fills `fluid.off_surface_and_walls` from `fluid.off_surface` and the walls within the kernel's support.
void find_off_surface_and_walls(Particles& fluid, const std::vector<Boundary>& boundaries,
                                const Kernel& kernel);

}  // namespace toryu::fluid
