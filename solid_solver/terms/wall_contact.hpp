/// Rigid walls acting on the solid, in the present configuration and alike in both formulations. As for a
/// fluid the walls are particles w, here on a lattice of the solid's spacing, and push by how much they
/// overlap:
///
///     S_i = sum_w V_w W_iw,   p_i = stiffness K max(0, S_i/S_0 - 1)
///     Dv_i/Dt = ... - (p_i/rho_0) sum_w V_w gradW_iw
///
/// S_0 is the sum of a particle half a spacing off a plane wall, where body and wall touch; p_i stands for
/// the pressure of the solid at the wall, that of Adami et al. (2012) taken from the one particle i. K is
/// that of the softest of several materials. Walls push but do not pull, and there is no friction. The force
/// is the gradient of the energy V_i stiffness K S_0/2 max(0, S_i/S_0 - 1)^2. A body pressed by p enters the
/// wall by about 0.4 h p/(stiffness K).
#pragma once

#include "common/scene/period.hpp"
#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/points.hpp"
#include "common/sph/strip_order.hpp"
#include "solid_solver/material.hpp"
#include "solid_solver/terms/overlap.hpp"

namespace toryu::solid {

class ContactWalls {
 public:
  /// Where the walls are, and what was near them at the last search.
  struct State {
    double time_placed = 0;             ///< of the present positions [s]
    double time_listed = 0;             ///< of the last search [s]
    std::vector<std::uint32_t> number;  ///< of the wall particle stored in a slot
    VecField solid_listed;              ///< positions of the solid at the last search [m]
    // Found anew from these:
    VecField x, x_listed;  ///< positions at present and at the last search, in the order of that [m]
    ClusterList list;
  };

  /// `spacing` and `h` [m] are the solid's. Where space repeats itself the positions x of the solid that the
  /// functions below take are those in the domain; who crosses a side jumps, which makes the lists anew.
  ContactWalls(const std::vector<Wall>& walls, const Contact& term, const ElasticMaterial& material,
               double spacing, double h, const Period& period = {});

  State start() const;
  /// Puts the walls where they are at `time` [s] and finds what they may touch among the first `count`
  /// particles at x [m].
  void prepare(State& state, const VecField& x, std::size_t count, double time) const;
  /// Finds anew what a checkpoint leaves out.
  void complete(State& state, std::size_t count) const;
  /// Acceleration [m/s2] of the particles of a cluster, of density rho_0 = 1/inverse_rho, after `prepare`.
  VecLanes acceleration(const State& state, const VecField& x, std::size_t cluster,
                        const Lanes& inverse_rho) const;
  /// Energy of the contact per volume of a particle [J/m3].
  Lanes energy_density(const State& state, const VecField& x, std::size_t cluster) const;

  std::size_t particle_count() const { return X_.size(); }
  double touching_sum() const { return S_0_; }
  /// Of a particle against a wall it touches firmly [1/s].
  double highest_frequency() const { return highest_frequency_; }

 private:
  void place(State& state, double time) const;
  /// Neighbours of the solid as it was listed, with the walls at that time.
  void list(State& state, std::size_t count) const;
  /// S and its gradient [1/m].
  Lanes overlap(const State& state, const VecField& x, std::size_t cluster, VecLanes& gradient) const;

  std::vector<Wall> walls_;
  Period period_;
  CubicSpline W_;
  double spacing_, pressure_scale_, skin_;
  double S_0_ = 0, highest_frequency_ = 0;
  std::vector<Vec> X_;                ///< at t = 0, by number [m]
  std::vector<std::size_t> wall_of_;  ///< index in walls_
};

template <class Archive>
void serialize(Archive& archive, ContactWalls::State& state) {
  auto& [time_placed, time_listed, number, solid_listed, x, x_listed, list] = state;
  archive(time_placed, time_listed, number, solid_listed);
}

}  // namespace toryu::solid
