/// Particles that act on the fluid as a wall: rigid walls and pistons, or the elastic solid's interface.
/// Their pressure and velocity are extrapolated from the fluid (Adami, Hu & Adams 2012; thesis eq. 27-29).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

struct Kinematics {
  Vec x, v, a;
};

struct Boundary {
  std::string name;
  bool moves = false;
  std::size_t count = 0;
  std::vector<std::uint32_t> id;  ///< number at the start: of a wall particle, or the interface's own order
  VecField x, v, acceleration;    ///< prescribed [m], [m/s], [m/s2]
  Field V, m, rho;                ///< volume [m2], mass of fluid in its place [kg/m], its density
  // extrapolated from the fluid
  Field p, p_rho2;         ///< (29) [Pa]
  Field eta;               ///< viscosity [Pa s], only where the medium is not Newtonian
  TensorField eta_grad_v;  ///< as of the fluid's particles
  VecField v_viscous;      ///< v_w-f = 2 v_w - v~_w, which the viscous terms use (28)
  VecField force;          ///< what the fluid does to the particle [N per metre depth], where asked for
  /// Outward area vector at the start [m per metre depth], zero inside; empty if this is no work piece.
  VecField area_vector;
  // where there is friction, of a work piece alone
  Field friction_length;    ///< d_s of (33) [m], see terms/friction.hpp
  VecField friction_force;  ///< on the particle [N per metre depth], where asked for

  ClusterList list_for_wall;   ///< for clusters of this boundary: the fluid's particles
  ClusterList list_for_fluid;  ///< for clusters of the fluid: this boundary's particles
  StripOrder strips{1.0};

  /// Sets `count` particles at `positions`, each of volume `particle_volume`, at rest.
  void place(const std::vector<Vec>& positions, const std::vector<double>& volumes, double rest_density,
             double strip_width);
  /// Makes it a work piece with these area vectors, by id.
  void make_work_piece(const std::vector<Vec>& area_vectors);
  bool is_work_piece() const { return !area_vector[0].empty(); }
  /// Puts the particles in strip order again after they moved.
  void sort();
  /// Sets position, velocity and acceleration from `motion(id)`, which gives them as a Kinematics.
  template <class Motion>
  void move(Motion&& motion);
};

template <class Motion>
void Boundary::move(Motion&& motion) {
  for (std::size_t k = 0; k < count; ++k) {
    const Kinematics now = motion(id[k]);
    set(x, k, now.x);
    set(v, k, now.v);
    set(acceleration, k, now.a);
  }
}

inline Sources sources(const Boundary& b) {
  return {pointers(b.x), pointers(b.v), pointers(b.v_viscous), {},           b.m.data(),
          b.V.data(),    b.rho.data(),  b.p_rho2.data(),       b.eta.data(), pointers(b.eta_grad_v)};
}

/// Extrapolates pressure (29) and velocity (27) from the fluid to the particles of `boundary` near it.
void extrapolate(Boundary& boundary, const Particles& fluid, const Kernel& kernel, const Vec& gravity);

/// Extrapolates viscosity and eta grad v of a medium that is not Newtonian likewise, as kernel means.
void extrapolate_viscosity(Boundary& boundary, const Particles& fluid, const Kernel& kernel);

}  // namespace toryu::fluid
