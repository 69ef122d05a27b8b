/// The steps in time.
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
/// pairs of its own. Sound is a leapfrog of rho and v: undamped, stable up to w dt = 2. Viscosity, density
/// diffusion and the factor rho of continuity are taken half a step old, to the first order.

#include "fluid_solver/fluid_solver.hpp"

namespace toryu::fluid {

namespace {

/// field += dt rate.
void add(VecField& field, double dt, const VecField& rate, std::size_t clusters) {
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < clusters; ++c)
    for (int a = 0; a < dim; ++a)
      store(load(field[a], c * lane_count) + dt * load(rate[a], c * lane_count), field[a], c * lane_count);
}
void add(Field& field, double dt, const Field& rate, std::size_t clusters) {
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < clusters; ++c)
    store(load(field, c * lane_count) + dt * load(rate, c * lane_count), field, c * lane_count);
}

}  // namespace

void FluidSolver::advance_from(const Start& start, double dt) {
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < fluid_.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    for (int a = 0; a < dim; ++a) {
      // x before v: its rate is the velocity of the evaluation, not the new one
      store(load(start.x[a], first) + dt * load(fluid_.v[a], first), fluid_.x[a], first);
      store(load(start.v[a], first) + dt * load(fluid_.a[a], first), fluid_.v[a], first);
    }
    store(load(start.rho, first) + dt * load(fluid_.drho, first), fluid_.rho, first);
  }
}

void FluidSolver::advance(double dt) {
  update_neighbours(dt);
  if (parameters_.seeks_free_surface()) {
    const auto timer = timers_.measure("free surface");
    free_surface_.find_off_surface(fluid_, neighbours_.of_fluid(), boundaries_, dynamics_.kernel());
    if (parameters_.keeps_off_walls()) find_off_surface_and_walls(fluid_, boundaries_, dynamics_.kernel());
  }
  if (parameters_.integrator == Integrator::symplectic)
    step_symplectic(dt);
  else
    step_midpoint(dt);
  if (shifting_) shift(dt);
  note_extremes();
}

void FluidSolver::update_neighbours(double dt) {
  const auto timer = timers_.measure("neighbours");
  if (!neighbours_.exhausted(fluid_, boundaries_, dt)) return;
  move_back_into_domain();
  neighbours_.build(fluid_, boundaries_);
}

void FluidSolver::step_midpoint(double dt) {
  start_.x = fluid_.x, start_.v = fluid_.v, start_.rho = fluid_.rho;
  dynamics_.evaluate(RatesOf::both, fluid_, neighbours_.of_fluid(), boundaries_, given_, timers_);
  advance_from(start_, 0.5 * dt);
  move_boundaries(time_ + 0.5 * dt);
  dynamics_.evaluate(RatesOf::both, fluid_, neighbours_.of_fluid(), boundaries_, given_, timers_);
  accumulate_reaction(dt);
  const auto timer = timers_.measure("step");
  advance_from(start_, dt);
  time_ += dt;
  move_boundaries(time_);
}

void FluidSolver::step_symplectic(double dt) {
  const auto evaluate = [&](RatesOf wanted) {
    dynamics_.evaluate(wanted, fluid_, neighbours_.of_fluid(), boundaries_, given_, timers_);
  };
  const std::size_t clusters = fluid_.clusters();
  if (!density_rate_known_) evaluate(RatesOf::density);
  density_rate_known_ = true;
  add(fluid_.x, 0.5 * dt, fluid_.v, clusters);
  add(fluid_.rho, 0.5 * dt, fluid_.drho, clusters);
  move_boundaries(time_ + 0.5 * dt);
  evaluate(RatesOf::velocity);
  accumulate_reaction(dt);
  add(fluid_.v, dt, fluid_.a, clusters);
  add(fluid_.x, 0.5 * dt, fluid_.v, clusters);
  time_ += dt;
  move_boundaries(time_);
  evaluate(RatesOf::density);
  add(fluid_.rho, 0.5 * dt, fluid_.drho, clusters);
}

/// Notes what the forces of the evaluation by which the velocity advances do to others over `dt`.
void FluidSolver::accumulate_reaction(double dt) {
  if (interface_boundary_) {
    const auto timer = timers_.measure("reaction on the interface");
    auto& boundary = boundaries_[*interface_boundary_];
    dynamics_.react(fluid_, boundary);
    interface_.add_load(boundary, given_[*interface_boundary_].force(), dt);
  }
  note_surface(dt);
  count_impulses(dt);
}

void FluidSolver::shift(double dt) {
  const auto timer = timers_.measure("shifting");
  shifting_->shift(fluid_, neighbours_.of_fluid(), boundaries_, largest_.speed, dt);
}

}  // namespace toryu::fluid
