/// The weakly compressible delta-SPH fluid: how the state advances, explicitly.
///
/// Midpoint (31)-(32): phi^(n+1/2) = phi^n + dt/2 F(phi^n), phi^(n+1) = phi^n + dt F(phi^(n+1/2)) for x, v
/// and rho: two evaluations a step; amplifies an undamped mode by 1 + (w dt)^4/4.
///
/// Symplectic: position Verlet with the density drifting along with x (Zhang, Rezavand & Hu 2021, eq. 21-24),
///
///     x, rho += dt/2 (v, drho(x^n, v^n));   v += dt a(x^(n+1/2), rho^(n+1/2), v^n);
///     x += dt/2 v;   rho += dt/2 drho(x^(n+1), v^(n+1))
///
/// drho of the end serves the next step's beginning, so each rate is found once a step, each by a loop over
/// pairs of its own; only beside an interface whose velocity a new window has changed it is found anew, for
/// otherwise the pressure would answer that change a step late. Sound is a leapfrog of rho and v: undamped,
/// stable up to w dt = 2. Viscosity, density diffusion and the factor rho of continuity are taken half a step
/// old, to the first order.
#pragma once

#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/weakly_compressible/dynamics.hpp"
#include "fluid_solver/weakly_compressible/shifting.hpp"

namespace toryu::fluid {

class WeaklyCompressible : public FluidModel {
 public:
  WeaklyCompressible(const Parameters& parameters, const Scene& scene, Filled filled = Filled::all);

  double time_step_limit() const override;
  std::string_view time_step_rule() const override;
  /// A step by the integrator of the case.
  void advance(double dt) override;
  std::vector<ActiveTerm> active_terms() const override { return dynamics_.active_terms(); }
  std::vector<Power> powers() override;

 private:
  /// The state at the start of a midpoint step.
  struct Start {
    VecField x, v;
    Field rho;
    std::vector<Field> log_conformation;
  };
  void step_midpoint(double dt);
  void step_symplectic(double dt);
  void advance_from(const Start& start, double dt);
  void evaluate(RatesOf wanted, double time);  ///< with the gravity at `time` [s]
  void accumulate_reaction(double dt);
  void shift(double dt);
  void renew_density_rates();
  void share_rates();  ///< with the other ranks
  void note_surface(double dt);
  void note_extremes();

  Dynamics dynamics_;
  Start start_;  ///< kept from step to step for its memory
  std::optional<Shifting> shifting_;
};

}  // namespace toryu::fluid
