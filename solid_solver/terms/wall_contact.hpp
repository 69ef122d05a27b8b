/// Rigid walls acting on the solid, in the present configuration and alike in both formulations. As for a
/// fluid the walls are particles w, here on a lattice of the solid's spacing, and push by how much they
/// overlap:
///
///     S_i = sum_w V_w W_iw,   p_i = stiffness K max(0, S_i/S_0 - 1)
///     Dv_i/Dt = ... - (p_i/rho_0) sum_w V_w gradW_iw
///
/// S_0 is the sum of a particle half a spacing off a plane wall, where body and wall touch; p_i stands for
/// the pressure of the solid at the wall, that of Adami et al. (2012) taken from the one particle i. Walls
/// push but do not pull, and there is no friction. The force is the gradient of the energy V_i stiffness K
/// S_0/2 max(0, S_i/S_0 - 1)^2. A body pressed by p enters the wall by about 0.4 h p/(stiffness K).
#pragma once

#include "common/scene/scene.hpp"
#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/points.hpp"
#include "common/sph/strip_order.hpp"
#include "solid_solver/material.hpp"
#include "solid_solver/terms/overlap.hpp"

namespace toryu::solid {

class ContactWalls {
 public:
  /// `spacing` and `h` [m] are the solid's.
  ContactWalls(const std::vector<Wall>& walls, const Contact& term, const ElasticMaterial& material,
               double spacing, double h);

  /// Puts the walls where they are at `time` [s] and finds what they may touch among the first `count`
  /// particles at x [m].
  void prepare(const VecField& x, std::size_t count, double time);
  /// Acceleration [m/s2] of the particles of a cluster, after `prepare`.
  VecLanes acceleration(const VecField& x, std::size_t cluster) const;
  /// Energy of the contact per volume of a particle [J/m3].
  Lanes energy_density(const VecField& x, std::size_t cluster) const;

  std::size_t particle_count() const { return number_.size(); }
  double touching_sum() const { return S_0_; }
  /// Of a particle against a wall it touches firmly [1/s].
  double highest_frequency() const { return highest_frequency_; }

 private:
  void place(double time);
  /// S and its gradient [1/m].
  Lanes overlap(const VecField& x, std::size_t cluster, VecLanes& gradient) const;

  std::vector<Wall> walls_;
  CubicSpline W_;
  double spacing_, pressure_scale_, inverse_rho_, skin_;
  double S_0_ = 0, highest_frequency_ = 0;
  std::vector<Vec> X_;                 ///< at t = 0 [m]
  std::vector<std::size_t> wall_of_;   ///< index in walls_
  std::vector<std::uint32_t> number_;  ///< of the wall particle stored in a slot
  VecField x_;                         ///< present positions, in the order of the last search [m]
  VecField x_listed_, solid_listed_;   ///< positions at the last search [m]
  StripOrder strips_;
  ClusterList list_;
};

}  // namespace toryu::solid
