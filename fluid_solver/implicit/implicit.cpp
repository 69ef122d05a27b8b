#include "fluid_solver/implicit/implicit.hpp"

#include <algorithm>
#include <cmath>

#include "common/error/counted.hpp"
#include "common/error/failure.hpp"
#include "common/run/log.hpp"
#include "common/sph/skin.hpp"
#include "fluid_solver/implicit/krylov.hpp"

namespace toryu::fluid {

namespace {

/// Of the spacing: how far a particle goes in a step.
constexpr double advection_share = 0.2;
/// Of what is meant: how far it may go in a step whose speed nothing foretold.
constexpr double ways_to_warn_of = 5;
/// Unbalanced force over the driving one up to which a viscosity is taken to change with the velocity as its
/// law says (Newton); farther off, where that may overshoot, it is kept (Picard).
constexpr double newton_from = 0.1;
/// Of the velocity, and that of walls where the medium is still slower: how far off the force is found again
/// for its derivative. Rounding takes 1e-7 of that.
constexpr double tangent_share = 1e-7;
/// The linear solver leaves so much of the unbalanced force, which the next update of the viscosity changes
/// by more, and at the last so much of what is tolerated.
constexpr double inner_tolerance = 0.1, last_tolerance = 0.5;

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
      largest_wall_speed_(largest_wall_speed(scene)) {
  if (std::any_of(scene.walls.begin(), scene.walls.end(), [](const Wall& wall) { return wall.press; }))
    largest_wall_speed_ = std::max(largest_wall_speed_, solver_.expected_speed);
  dynamics_.allocate(state_.fluid);
  resize(state_.fluid.a_before, state_.fluid.rho.size());
  if (parameters.particle_shifting)
    shifting_.emplace(*parameters.particle_shifting, parameters.spacing, kernel_);
  state_.balance = EnergyBalance(powers());
  note_extremes();
}

double Implicit::time_step_limit() const {
  const double length = advection_share * parameters_.time_step_share * parameters_.spacing;
  const double u = std::max({state_.largest.speed, largest_wall_speed_, solver_.expected_speed}),
               g = scene_.gravity.norm();
  return std::min(length / u, std::sqrt(length / g));
}

void Implicit::advance(double dt) {
  update_neighbours(dt);
  if (shifting_) {
    const auto timer = timers_.measure("free surface");
    free_surface_.find_off_surface(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, kernel_);
  }
  move(state_.fluid, 0.5 * dt);
  move_boundaries(state_.time + 0.5 * dt);
  for (Boundary& boundary : state_.boundaries)
    if (auto* pressed = std::get_if<PressedMotion>(&boundary.motion))
      pressed->begin_step(state_.time + 0.5 * dt, state_.time + dt);
  solve(dt);
  note_surface(dt);
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
  warn_of_way(state_.largest.speed * dt);
}

void Implicit::warn_of_way(double way) {
  const double meant = advection_share * parameters_.time_step_share * parameters_.spacing;
  if (way < std::max(ways_to_warn_of * meant, parameters_.spacing) || warned_of_way_) return;
  warned_of_way_ = true;
  log::warn(
      "a particle went {:.3g} spacings in the step to t = {:.6g} s, where {:.3g} are meant: nothing told its "
      "speed before; give 'expected_speed' in [fluid.implicit], {:.3g} m/s or more",
      way / parameters_.spacing, state_.time, meant / parameters_.spacing, state_.largest.speed);
}

void Implicit::solve(double dt) {
  const auto timer = timers_.measure("implicit system");
  StepSystem system(terms_, state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, dt);
  StepSystem::Vector v = system.foreseen_velocities();
  StepSystem::Vector r = system.unbalance_between_stops(v);
  const double driving = system.driving().norm();
  const double tolerated = std::max(solver_.tolerance * driving, system.rounding());
  Effort effort{.steps = 1};
  bool overshot = false;
  for (double before = r.norm(); before > tolerated;) {
    const bool near = before <= newton_from * driving && !overshot;
    const double wanted = last_tolerance * tolerated / before;
    const bool linear = !terms_.viscosity_varies() && !terms_.slides();
    correct(system, r, near && !linear ? Viscosity::renewed : Viscosity::kept,
            linear ? wanted : std::max(wanted, inner_tolerance), v, effort);
    r = system.unbalance_between_stops(v);
    ++effort.viscosity_updates;
    const double after = r.norm();
    if (after > tolerated) fail_unless_solvable(after / driving, effort);
    overshot = overshot || (near && after > before);
    before = after;
  }
  if (effort.viscosity_updates == 0) system.unbalance(v, Viscosity::kept);  // what `driving` has overwritten
  system.finish(v);
  effort_.steps += effort.steps;
  effort_.iterations += effort.iterations;
  effort_.viscosity_updates += effort.viscosity_updates;
}

void Implicit::correct(StepSystem& system, const StepSystem::Vector& r, Viscosity viscosity, double tolerance,
                       StepSystem::Vector& v, Effort& effort) const {
  const double of_walls = largest_wall_speed_ * std::sqrt(static_cast<double>(v.size()));
  double speed = std::max(v.norm(), of_walls);
  if (speed == 0) speed = r.norm();  // of a medium at rest that gravity pulls
  const Product product = [&](const StepSystem::Vector& x) -> StepSystem::Vector {
    if (viscosity == Viscosity::kept && !terms_.slides())
      return r - system.unbalance(v + x, viscosity);  // is linear
    if (x.isZero(0)) return x;
    const double share = tangent_share * speed / x.norm();
    return (r - system.unbalance(v + share * x, viscosity)) / share;
  };
  const BlockJacobi blocks(system.diagonal());
  std::optional<CoarseFlow> coarse;
  if (scene_.periodic == Periodic::none) coarse = system.coarse_flow();
  const Product preconditioner = [&](const StepSystem::Vector& x) -> StepSystem::Vector {
    if (!coarse) return blocks(x);
    return blocks(x) + coarse->correction(state_.fluid.x, state_.fluid.m, x);
  };
  const KrylovResult found =
      solve_by_gmres(product, preconditioner, r, tolerance, solver_.largest_iterations - effort.iterations);
  v += found.x;
  effort.iterations += found.iterations;
}

void Implicit::fail_unless_solvable(double unbalance, const Effort& effort) const {
  if (std::isfinite(unbalance) && effort.iterations < solver_.largest_iterations &&
      effort.viscosity_updates < solver_.largest_viscosity_updates)
    return;
  const std::string taken =
      effort.viscosity_updates >= solver_.largest_viscosity_updates
          ? counted(effort.viscosity_updates, "update") +
                " of the viscosity (fluid.implicit.largest_viscosity_updates)"
          : fmt::format("{} of the linear solver (fluid.implicit.largest_iterations: {})",
                        counted(effort.iterations, "iteration"), solver_.largest_iterations);
  throw PhysicsFailure(
      "fluid", -1, state_.time,
      "the implicit step is not solved: unbalanced force over the driving one after " + taken,
      fmt::format("{:.3g}", unbalance), fmt::format("{:g} (fluid.implicit.tolerance)", solver_.tolerance));
}

void Implicit::note_surface(double dt) {
  if (!state_.surface_record) return;
  const auto timer = timers_.measure("surface of the work pieces");
  state_.surface_record->add(state_.boundaries, state_.fluid, pressure_offset(), state_.neighbours.of_fluid(),
                             kernel_, dt);
}

void Implicit::note_extremes() {
  state_.largest.speed = largest_norm(state_.fluid.v, state_.fluid.count);
  state_.largest.acceleration = largest_norm(state_.fluid.a, state_.fluid.count);
}

std::vector<ActiveTerm> Implicit::active_terms() const {
  auto texts = dynamics_.active_terms();
  texts.push_back({"implicit steps", "(v - v^n)/dt = a(v), with p = p^n + c^2 dt drho(v)",
                   "backward Euler; GMRES by Saad & Schultz 1986",
                   fmt::format("tolerance {:g}, a particle goes {:g} spacings in a step", solver_.tolerance,
                               advection_share * parameters_.time_step_share)});
  return texts;
}

std::vector<std::pair<std::string, double>> Implicit::figures() const {
  const auto per_step = [&](long count) {
    return static_cast<double>(count) / static_cast<double>(std::max(1L, effort_.steps));
  };
  return {
      {"iterations_per_step", per_step(effort_.iterations)},
      {"viscosity_updates_per_step", terms_.viscosity_varies() ? per_step(effort_.viscosity_updates) : 0.0}};
}

}  // namespace toryu::fluid
