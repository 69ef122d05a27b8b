/// Creeping media: velocity and pressure implicit together, in steps as long as advection allows.
///
/// A step from t to t + dt, by backward Euler with the places of its middle:
///
///     x += dt/2 v^n;   v = the solution of step_system.hpp;   x += dt/2 v;   rho += dt drho(v)
///
/// The density stays the state and gives the pressure, as in the weakly compressible model: what is implicit
/// is that pressure and viscous force are those of the new velocity. Long steps damp inertia and sound, and
/// what remains is the Stokes flow; errors in time are of first order. The places limit the step: a particle
/// goes 0.2 spacings in one.
///
/// The velocities are foreseen by the acceleration of the last step, and corrected until the forces are in
/// balance with the viscosity at their own shear rates:
///
///     |v^n + dt a(v) - v| <= tolerance |v^n + dt a(0)|        with eta(v), in the root mean square
///
/// where of pressed walls what press and medium do counts on the right, and not their momentum: a heavy
/// piston would loosen what is asked of the medium.
///
/// Far from balance a viscosity is found anew after each correction (Picard); near it the correction knows
/// its derivative (Newton), by a difference of two evaluations (Knoll & Keyes 2004). For n = 0.4 the
/// foresight leaves a third of the iterations, and the derivative two thirds of those (cases/abrasive_throat,
/// 10 across). A grid that knows the smooth part of the flow (coarse_flow.hpp) leaves a quarter of what is
/// left at 20 across. Lagged by a step instead it would be right in steady flow alone. A step whose system is
/// not solved so far ends the run.
#pragma once

#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/implicit/step_system.hpp"
#include "fluid_solver/weakly_compressible/dynamics.hpp"
#include "fluid_solver/weakly_compressible/shifting.hpp"

namespace toryu::fluid {

class Implicit final : public FluidModel {
 public:
  Implicit(const Parameters& parameters, const Scene& scene);

  /// Infinite where nothing moves or pulls.
  double time_step_limit() const override;
  std::string_view time_step_rule() const override { return "advection"; }
  /// Throws PhysicsFailure if the system of the step is not solved.
  void advance(double dt) override;
  std::vector<ActiveTerm> active_terms() const override;
  std::vector<Power> powers() override {
    return dynamics_.powers(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries);
  }
  std::vector<std::pair<std::string, double>> figures() const override;

 private:
  /// What the solver has done, in a step or in all.
  struct Effort {
    long steps = 0, iterations = 0, viscosity_updates = 0;
  };
  void solve(double dt);
  /// Adds to `v` what takes the unbalanced force `r` down to `tolerance` of it, if the viscosity is kept or
  /// changes as its law says.
  void correct(StepSystem& system, const StepSystem::Vector& r, Viscosity viscosity, double tolerance,
               StepSystem::Vector& v, Effort& effort) const;
  /// Throws PhysicsFailure for a step that is still unbalanced after all that it may take.
  void fail_unless_solvable(double unbalance, const Effort& effort) const;
  /// Adds what a step does to the work pieces to their record.
  void note_surface(double dt);
  void note_extremes();
  /// Once in a process, of a step in which a particle went this far [m] and much farther than is meant.
  void warn_of_way(double way);

  Dynamics dynamics_;
  ImplicitTerms terms_;
  ImplicitSolver solver_;
  double largest_wall_speed_;  ///< over all of the run, of walls that are pressed as expected [m/s]
  std::optional<Shifting> shifting_;
  Effort effort_;  ///< of this process
  bool warned_of_way_ = false;
};

}  // namespace toryu::fluid
