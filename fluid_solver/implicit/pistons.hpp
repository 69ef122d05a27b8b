/// Walls that are pressed, in an implicit step: their speeds u_k along the axis of their press are unknowns
/// of its system, beside the velocities of the medium. With F_k what the medium does to piston k at these
/// velocities, along the axis, and the press's pressure p_k at the end of the step,
///
///     M_k (u_k - u_k^n)/dt = A_k (p_k - q) + F_k,   u_least <= u_k <= u_most,
///
/// q being what of the pressure the medium does not know (held_pressure.hpp), and A_k the area over which the
/// medium meets the piston (press_area.hpp). In long steps the inertia is nothing beside the forces, and the
/// piston goes as fast as balances them. The bounds take it as far as its stops in the half of the step that
/// is left: where it meets one and is pushed on, the stop bears the rest of the force, and the row says u_k =
/// its bound (an active set by projection, Bertsekas 1982).
///
/// A row stands over the mass m_k = rho_0 A_k d_0 of the row of particles before the face, so that an
/// unbalanced force counts as on a particle there, however heavy the piston.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/implicit/coarse_flow.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

class Pistons {
 public:
  using Vector = Eigen::VectorXd;

  /// Of those `boundaries` that are pressed, for a step of `dt` [s] that they have begun
  /// (PressedMotion::begin_step); they must outlive it.
  Pistons(std::vector<Boundary>& boundaries, const Parameters& parameters, const EquationOfState& state,
          double dt);

  Eigen::Index count() const { return static_cast<Eigen::Index>(all_.size()); }
  /// Of the last step [m/s], [m/s2].
  Vector speeds() const;
  Vector accelerations() const;
  /// Gives their particles the speeds `u` [m/s].
  void move_at(const Vector& u);
  /// u^n + dt (A (p - q) + F)/M - u, over m/M, of what the last evaluation did [m/s]; of one that a stop
  /// holds how far it is off its bound.
  Vector unbalance(const Vector& u) const;
  /// Of the same, at rest, what press and medium do, dt (A (p - q) + F)/m: the momentum that a piston brings
  /// drives nothing [m/s].
  Vector driving() const;

  /// The areas, by `fluid` and by walls whose densities are known. Until then they are those of the faces.
  /// Throws PhysicsFailure where one is not near that of the face.
  void take_areas(const Particles& fluid, const Kernel& kernel);

  /// Takes `u` back between the bounds, and lets all go.
  void release(Vector& u);
  /// After an evaluation at `u`: holds those that are pushed on at a bound.
  void hold_at_stops(const Vector& u);

  /// They leave the step at these speeds.
  void finish(const Vector& u);

  /// The number of the piston that `boundary` is, unless a stop holds it.
  std::optional<Eigen::Index> free_number_of(const Boundary& boundary) const;
  /// Of all, what the preconditioner knows; one that a stop holds stays where it is.
  std::vector<CoarseFlow::Piston> of_coarse_flow() const;
  Vec axis(Eigen::Index k) const { return motion(k).press.axis(); }

 private:
  struct Piston {
    Boundary* boundary;
    double pressure;                   ///< p - q [Pa]
    double area;                       ///< A [m]
    double row_mass;                   ///< [kg/m]
    double least, most;                ///< bounds of its speed [m/s]
    std::optional<double> bound = {};  ///< at which a stop holds it
  };
  const Piston& at(Eigen::Index k) const { return all_[static_cast<std::size_t>(k)]; }
  PressedMotion& motion(Eigen::Index k) const { return std::get<PressedMotion>(at(k).boundary->motion); }
  /// A (p - q) + F of the last evaluation [N/m].
  double force_on(Eigen::Index k) const;
  /// M u^n + dt (A (p - q) + F) - M u, over m [m/s].
  double unbalanced_force(Eigen::Index k, double u) const;

  double dt_;
  std::vector<Piston> all_;
};

}  // namespace toryu::fluid
