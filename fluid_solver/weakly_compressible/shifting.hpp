/// Particle shifting (Lind, Xu, Stansby & Rogers 2012; strength and tensile part by Sun, Colagrossi, Marrone
/// & Zhang 2017): after each step particles move from where they are crowded to where they are few,
///
///     dx_i = -A h u_max dt sum_j V_j [1 + R (W_ij/W(d_0))^4] gradW_ij,    R = 0.2,   |dx_i| <= u_max dt/2
///
/// over fluid and walls, so that streamlines do not comb them into rows with gaps between. What is carried
/// stays in its place to first order: v_i += dx_i . grad v, rho_i += dx_i . grad rho with renormalised
/// gradients, and so is the log-conformation of a viscoelastic medium. Near a free surface the sum would push
/// particles out: they are left alone there.
///
/// Where a wall is in reach the density follows the particles instead, as in any other motion,
///
///     rho_i += rho_i sum_j V_j (dx_i - dx_j) . gradW_ij,      dx = 0 of walls.
///
/// Else it would drift: continuity counts how the flow crowds particles against a wall, and a shift that
/// spreads them again uncounted lets it count the same crowding at every step. In
/// `cases/abrasive_flow/rigid.toml` it was 15 % too high after 0.6 s. Inside, where nothing holds one side,
/// the carried field is better: the density does not feel the disorder.
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
  /// What is carried to the new places of one cluster.
  struct Moved {
    VecLanes v;
    Lanes rho;
  };
  template <class W>
  Lanes density_beside_walls(const Particles& fluid, const ClusterList& neighbours,
                             const std::vector<Boundary>& boundaries, const W& kernel,
                             std::size_t cluster) const;

  /// Moves the log-conformation along, before the places change.
  template <class W>
  void carry_log_conformation(Particles& fluid, const ClusterList& neighbours, const W& kernel);

  double strength_, spacing_;
  Kernel kernel_;
  // kept from step to step for their memory
  std::vector<Moved> moved_;
  VecField dx_;
  std::vector<Field> carried_;
};

}  // namespace toryu::fluid
