/// Contact between bodies in total Lagrangian form, whose neighbours are those of the unloaded body: bodies
/// that no chain of neighbours joins would pass through each other. As at walls (wall_contact.hpp) particles
/// push by how much they overlap, here with particles j of other bodies:
///
///     S_i = sum_j V_j W_ij,   p_i = stiffness K max(0, S_i/S_0 - 1)
///     Dv_i/Dt = ... - 1/rho_0 sum_j V_j (p_i + p_j) gradW_ij
///
/// S_0 is the sum of a particle whose body touches another with plane faces, K that of the softest of several
/// materials. The force is the gradient of the
/// energy sum_i V_i stiffness K S_0/2 max(0, S_i/S_0 - 1)^2, so momentum and energy are kept. There is no
/// friction, and a body does not touch itself, nor its images where space repeats itself.
#pragma once

#include <cstdint>
#include <vector>

#include "common/sph/kernel.hpp"
#include "common/sph/points.hpp"
#include "solid_solver/material.hpp"
#include "solid_solver/shape.hpp"
#include "solid_solver/terms/overlap.hpp"

namespace toryu::solid {

class TouchingBodies {
 public:
  struct Pair {
    std::uint32_t i, j;
    Vec shift;  ///< of i: a period, or zero [m]
    Vec between(const VecField& x) const { return at(x, i) + shift - at(x, j); }
  };
  struct State {
    VecField x_listed;        ///< positions at the last search [m]
    Field S;                  ///< of the last push
    std::vector<Pair> pairs;  ///< of different bodies, within the support and the skin of x_listed
  };

  /// `X` [m] and `volume` [m2] of the first `count` particles in storage order, which must not change.
  /// `spacing` and `h` [m] are the solid's. Bodies are what a chain of neighbours joins within `shape`. Where
  /// space repeats itself by `shifts` (Period), the positions that `push` takes are those in the domain; who
  /// crosses a side jumps, which makes the pairs anew.
  TouchingBodies(const VecField& X, const Field& volume, std::size_t count, const Contact& term,
                 const ElasticMaterial& material, double spacing, double h, const Shape& shape = {},
                 const std::vector<Vec>& shifts = {Vec::Zero()});

  /// Adds the push at positions x [m] to the accelerations a [m/s2] of particles of the density
  /// 1/inverse_rho.
  void push(State& state, const VecField& x, const Field& inverse_rho, VecField& a) const;
  /// Finds anew the pairs, which a checkpoint leaves out.
  void find_pairs(State& state) const;
  /// After `push` [J per metre depth].
  double energy(const State& state) const;

  std::size_t body_count() const { return bodies_; }
  double touching_sum() const { return S_0_; }
  /// Of a particle against a body it touches firmly [1/s].
  double highest_frequency() const { return highest_frequency_; }

 private:
  std::vector<Vec> points(const VecField& x) const;
  void find_bodies(const std::vector<Vec>& X, const Shape& shape);
  void find_pairs_if_moved(State& state, const VecField& x) const;
  double pressure(const State& state, std::size_t i) const;

  Field V_;
  std::size_t count_;
  std::vector<Vec> shifts_;
  CubicSpline W_;
  double pressure_scale_, skin_;
  double S_0_ = 0, highest_frequency_ = 0;
  std::size_t bodies_ = 0;
  std::vector<std::uint32_t> body_;  ///< of each particle
};

template <class Archive>
void serialize(Archive& archive, TouchingBodies::State& state) {
  auto& [x_listed, S, pairs] = state;
  archive(x_listed, S);
}

}  // namespace toryu::solid
