#include "fluid_solver/implicit/implicit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/error/failure.hpp"
#include "common/sph/skin.hpp"
#include "fluid_solver/implicit/krylov.hpp"

namespace toryu::fluid {

namespace {

/// Of the spacing: how far a particle goes in a step.
constexpr double advection_share = 0.2;
/// Of the unbalanced force that an update of the viscosity leaves: what the linear solver leaves of it.
constexpr double inner_tolerance = 0.1;

double largest_speed_of(const std::vector<Wall>& walls) {
  double largest = 0;
  for (const Wall& wall : walls)
    if (wall.motion)
      for (const auto& row : wall.motion->velocity)
        largest = std::max(largest, std::abs(wall.motion->speed) * std::hypot(row[1], row[2]));
  return largest;
}

void move(Particles& fluid, double dt) {
  for (int a = 0; a < dim; ++a)
    for (std::size_t i = 0; i < fluid.count; ++i) fluid.x[a][i] += dt * fluid.v[a][i];
}

}  // namespace

Implicit::Implicit(const Parameters& parameters, const Scene& scene)
    : FluidModel(parameters, scene),
      dynamics_(parameters, scene.gravity, kernel_, equation_of_state_),
      terms_(parameters, scene.gravity, kernel_, equation_of_state_),
      solver_(parameters.implicit.value_or(ImplicitSolver{})),
      largest_wall_speed_(largest_speed_of(scene.walls)) {
  dynamics_.allocate(state_.fluid);
  if (parameters.particle_shifting)
    shifting_.emplace(*parameters.particle_shifting, parameters.spacing, kernel_);
  state_.balance = EnergyBalance(powers());
  note_extremes();
}

double Implicit::time_step_limit() const {
  const double length = advection_share * parameters_.time_step_share * parameters_.spacing;
  const double u = std::max(state_.largest.speed, largest_wall_speed_), g = scene_.gravity.norm();
  return std::min(length / u, std::sqrt(length / g));  // infinite in a fluid at rest
}

std::string_view Implicit::time_step_rule() const {
  return "advection";
}

void Implicit::advance(double dt) {
  update_neighbours(dt);
  if (shifting_) {
    const auto timer = timers_.measure("free surface");
    free_surface_.find_off_surface(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, kernel_);
  }
  move(state_.fluid, 0.5 * dt);
  move_boundaries(state_.time + 0.5 * dt);
  StepSystem system(terms_, state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, dt);
  solve(system, dt);
  count_forces(dt);
  move(state_.fluid, 0.5 * dt);
  for (std::size_t i = 0; i < state_.fluid.count; ++i) state_.fluid.rho[i] += dt * state_.fluid.drho[i];
  state_.time += dt;
  move_boundaries(state_.time);
  if (shifting_) {
    const auto timer = timers_.measure("shifting");
    shifting_->shift(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, state_.largest.speed, dt);
  }
  note_extremes();
}

void Implicit::solve(StepSystem& system, double dt) {
  const auto timer = timers_.measure("implicit system");
  using Vector = StepSystem::Vector;
  Vector v = system.velocities();
  const Vector v_n = v, zero = Vector::Zero(v.size());
  long left = solver_.largest_iterations;
  static const bool talk = std::getenv("TALK");
  for (int update = 0;; ++update) {
    system.set_velocities(v);
    system.update_viscosity();
    const Vector b = system.unbalance(zero), r = system.unbalance(v);
    const double driving = b.norm(), found = r.norm() / driving;
    if (talk) fmt::print("t {} update {} driving {} residual {}\n", state_.time, update, driving, found);
    if (found <= solver_.tolerance || driving == 0) break;
    if (update == solver_.largest_viscosity_updates || !std::isfinite(found) || left == 0)
      throw PhysicsFailure("fluid", -1, state_.time, fmt::format("unbalanced force of the implicit step, over the driving force, after {} iterations", solver_.largest_iterations - left),
                           fmt::format("{:.3g}", found), fmt::format("{:g} (fluid.implicit.tolerance)", solver_.tolerance));
    const double wanted = terms_.viscosity_varies() ? std::max(inner_tolerance, 0.5*solver_.tolerance / found) : 0.5* solver_.tolerance / found;
    const auto solved = solve_by_bicgstab([&](const Vector& x) -> Vector { return b - system.unbalance(x); },
                                          system.diagonal(), r, wanted, left);
    if (talk) fmt::print("   its {} res {}\n", solved.iterations, solved.residual);
    v += solved.x;
    iterations_ += solved.iterations;
    left -= std::min(left, solved.iterations);
    ++updates_;
  }
  const auto n = static_cast<Eigen::Index>(state_.fluid.count);
  const Vector a = (v - v_n) / dt;
  for (int k = 0; k < dim; ++k) Eigen::Map<Vector>(state_.fluid.a[k].data(), n) = a.segment(k * n, n);
  ++steps_;
}

void Implicit::note_extremes() {
  state_.largest.speed = largest_norm(state_.fluid.v, state_.fluid.count);
  state_.largest.acceleration = largest_norm(state_.fluid.a, state_.fluid.count);
}

std::vector<ActiveTerm> Implicit::active_terms() const {
  auto texts = dynamics_.active_terms();
  texts.push_back({"implicit steps", "rho/dt (v - v^n) = -G p(v) + V v + rho g", "",
                   fmt::format("tolerance {:g}", solver_.tolerance)});
  return texts;
}

std::vector<std::pair<std::string, double>> Implicit::figures() const {
  const double steps = static_cast<double>(std::max(1L, steps_));
  return {{"solver_iterations_per_step", static_cast<double>(iterations_) / steps},
          {"viscosity_updates_per_step", static_cast<double>(updates_) / steps}};
}

}  // namespace toryu::fluid
