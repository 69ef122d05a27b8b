/// Creeping media: velocity and pressure implicit together, in steps as long as advection allows.
///
/// A step from t to t + dt (backward Euler; positions by the velocities of either end):
///
///     x += dt/2 v^n;   v = the solution of step_system.hpp at these places;   x += dt/2 v;   rho += dt drho(v)
///
/// The density stays the state and gives the pressure, as in the weakly compressible model; what is implicit is
/// how both answer the velocity. With long steps inertia and sound are damped away, and what remains is the
/// Stokes flow. A viscosity that varies with the shear rate is found anew (Picard) until the force is balanced
/// with it.
#pragma once

#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/implicit/step_system.hpp"
#include "fluid_solver/weakly_compressible/dynamics.hpp"
#include "fluid_solver/weakly_compressible/shifting.hpp"

namespace toryu::fluid {

class Implicit final : public FluidModel {
 public:
  Implicit(const Parameters& parameters, const Scene& scene);

  double time_step_limit() const override;
  std::string_view time_step_rule() const override;
  /// Throws PhysicsFailure if the system of the step is not solved.
  void advance(double dt) override;
  std::vector<ActiveTerm> active_terms() const override;
  std::vector<Power> powers() const override {
    return dynamics_.powers(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries);
  }
  std::vector<std::pair<std::string, double>> figures() const override;

 private:
  void solve(StepSystem& system, double dt);
  void note_extremes();

  Dynamics dynamics_;
  ImplicitTerms terms_;
  ImplicitSolver solver_;
  double largest_wall_speed_;  ///< over all of the run [m/s]
  std::optional<Shifting> shifting_;
  long steps_ = 0, iterations_ = 0, updates_ = 0;  ///< of this process
};

}  // namespace toryu::fluid
