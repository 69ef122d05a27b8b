/// Particle shifting (Lind, Xu, Stansby & Rogers 2012; strength and tensile part by Sun, Colagrossi, Marrone
/// & Zhang 2017): after each step particles move from where they are crowded to where they are few,
///
///     dx_i = -A h u_max dt sum_j V_j [1 + R (W_ij/W(d_0))^4] gradW_ij,    R = 0.2,   |dx_i| <= u_max dt/2
///
/// over fluid and walls, so that streamlines do not comb them into rows with gaps between. What is carried
/// stays in its place to first order: v_i += dx_i . grad v, rho_i += dx_i . grad rho with renormalised
/// gradients. ShiftedNeighbours a free surface the sum would push particles out: they are left alone there.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/terms/particle_shifting.hpp"

namespace toryu::fluid {

class Shifting {
 public:
  Shifting(const ParticleShifting& parameters, double spacing, const Kernel& kernel)
      : strength_(parameters.strength), spacing_(spacing), kernel_(kernel) {}

  /// Shifts `fluid`, where it is `off_surface`, by what belongs to a step of `dt` [s] at a largest speed of
  /// `largest_speed` [m/s].
  void shift(Particles& fluid, const ClusterList& neighbours, const std::vector<Boundary>& boundaries,
             double largest_speed, double dt);

 private:
  /// What the particles of one cluster become.
  struct Moved {
    VecLanes x, v;
    Lanes rho;
  };

  double strength_, spacing_;
  Kernel kernel_;
  std::vector<Moved> moved_;  // kept from step to step for its memory
};

}  // namespace toryu::fluid
