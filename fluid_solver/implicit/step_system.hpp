/// The system that one implicit step solves: all velocities v at the end of the step, with the places x of
/// its middle,
///
///     (v_i - v_i^n)/dt = a_i(v),   a_i = pressure with p(v) + viscosity with v + gravity
///     p_i(v) = p_i^n + c_i^2 dt drho_i(v),   c_i^2 = dp/drho at rho_i^n
///     drho_i(v) = rho_i sum_j V_j v_ij . gradW_ij
///
/// and, where walls are pressed, of the speeds of these pistons (pistons.hpp), last in v,
///
/// with the walls' pressure and velocity extrapolated from p(v) and v; where the medium slides, with the slip
/// of v, found wall particle by wall particle as by the explicit model. For a given viscosity, and without
/// slip, it is linear in v: with V the viscous sweep, D and G those of continuity and pressure and K = rho
/// c^2,
///
///     (rho/dt - V + dt G K D) v = rho v^n/dt - G p^n + rho g + what walls that move do.
///
/// Nothing is assembled: a product is one evaluation of the explicit model's sums, so that each pair has the
/// force that it has there. Pressure and viscosity are not split as projection methods do: that leaves an
/// error of the order of dt nu/w^2 between walls w apart, and dt is far above w^2/nu here.
///
/// The matrix is not symmetric: where walls extrapolate, the force of a pair depends on who else is near.
/// Where no wall is in reach, G is minus the adjoint of D but for the ratio of the two densities, and the sum
/// of m_i times its rows is that of m_i/dt: momentum is kept as by the explicit sweeps.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "common/sph/renormalisation.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/implicit/coarse_flow.hpp"
#include "fluid_solver/implicit/pistons.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/weakly_compressible/pair_sweeps.hpp"

namespace toryu::fluid {

/// What of the model stays the same from step to step.
struct ImplicitTerms {
  ImplicitTerms(const Parameters& of_case, const Vec& gravity, const Kernel& W,
                const EquationOfState& of_medium);
  bool viscosity_varies() const { return std::holds_alternative<VariableViscosityTerm>(chosen.viscous); }
  bool slides() const { return parameters.wall_slip.has_value(); }
  PairSweeps sweeps(const ChosenTerms& terms) const {
    return {terms, body_force, viscous_walls, true, parameters.density, false};
  }

  Parameters parameters;
  Kernel kernel;
  EquationOfState state;
  BodyForce body_force;
  ChosenTerms chosen;
  bool viscous_walls;
};

/// At which the force is found: that of before, or that of the shear rates of its own velocities.
enum class Viscosity { kept, renewed };

class StepSystem {
 public:
  using Vector = Eigen::VectorXd;
  using Block = Eigen::Matrix2d;

  /// For a step of `dt` [s] from the velocities, densities and, if it varies, viscosity of `fluid`, whose
  /// places and whose boundaries are at the middle of the step, which those that are pressed have begun.
  StepSystem(const ImplicitTerms& terms, Particles& fluid, const ClusterList& neighbours,
             std::vector<Boundary>& boundaries, double dt);

  /// All velocities, x before y, and then speeds of pistons, if the acceleration stays that of the last step
  /// [m/s].
  Vector foreseen_velocities() const;
  /// Leaves `v` in `fluid`, and the acceleration that leads to it.
  void finish(const Vector& v);

  /// v^n + dt a(v) - v [m/s]: the unbalanced force, over m/dt. Leaves p, drho and a of `fluid` and what the
  /// boundaries do to it.
  Vector unbalance(const Vector& v, Viscosity viscosity);
  /// The same at rest, with the viscosity as it is, without the momentum of pistons: the force that drives
  /// the medium.
  Vector driving();
  /// The unbalance with a renewed viscosity, of pistons no faster than their stops allow: takes `v` back to
  /// that, and finds out whom a stop holds.
  Vector unbalance_between_stops(Vector& v);
  /// The blocks of the matrix 1 - dt da/dv on its diagonal, those of the walls' extrapolation left out.
  std::vector<Block> diagonal() const;
  /// What the system is to smooth velocities, for its preconditioner.
  /// Norm of the unbalance that rounding leaves: pressures are found from densities, to parts of rho c^2.
  double rounding() const;
  /// Nothing where the medium is so scattered that the grid over all of it has more cells than particles.
  std::optional<CoarseFlow> coarse_flow() const;

 private:
  Eigen::Index components() const { return dim * static_cast<Eigen::Index>(fluid_.count); }
  /// Of all particles, with `speeds` behind.
  Vector joined(const VecField& field, const Vector& speeds) const;
  void move_at(const Vector& v);
  void evaluate(Viscosity viscosity);
  template <class W>
  void find_moment(const W& kernel, std::size_t cluster);
  /// The rate of the density, the pressure that follows, and in `eta_grad_v` what the gradient of the
  /// velocity has of the fluid.
  template <class W>
  void compress(const W& kernel, std::size_t cluster);
  /// The rest of that gradient, of walls, times the viscosity.
  template <class W>
  void stresses(const W& kernel, std::size_t cluster, Viscosity viscosity);

  const ImplicitTerms& terms_;
  Particles& fluid_;
  const ClusterList& neighbours_;
  std::vector<Boundary>& boundaries_;
  double dt_;
  Pistons pistons_;
  double p_offset_;  ///< what contact adds to the pressure, for friction [Pa]
  Vector v_n_;
  Field p_n_, c2_;               ///< [Pa], [m2/s2]
  std::vector<Moment> moments_;  ///< of a cluster each, where the viscosity varies
};

}  // namespace toryu::fluid
