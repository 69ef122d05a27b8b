#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/sph/skin.hpp"
#include "fluid_solver/held_volume.hpp"
#include "fluid_solver/stability_warnings.hpp"
#include "fluid_solver/weakly_compressible/found_values.hpp"
#include "fluid_solver/weakly_compressible/polymer.hpp"

namespace toryu::fluid {

namespace {

// Shares of the limits, Monaghan 1992 and thesis section 5. A drag is stable up to 2 over its rate, and so is
// a relaxation.
constexpr double acoustic_share = 0.25, viscous_share = 0.125, force_share = 0.25, friction_share = 0.5,
                 relaxation_share = 0.25;
/// Shares of the viscous limit beyond which no step goes, whatever `time_step_share`. A step of the velocity
/// is stable up to 2 over the largest rate of the Laplacian, by sums over a lattice 0.35 h^2/nu with the
/// cubic spline and 0.29 to 0.33 with Wendland C2 (h/d_0 from 2 to 1.2): 2.4 to 2.8 times the limit.
constexpr double largest_viscous_share = 2;
/// The same of friction, a drag: 1.5 over its rate.
constexpr double largest_friction_share = 3;
/// About an axis. A ring weighs less, the nearer it is, and its viscous rate is up to three times that in a
/// plane. Sound is faster by the square root of 2 where the density answers to a hoop as it does to a side,
/// and rings that a passage draws towards the axis come to stand farther apart than the spacing, with more
/// weight each: a round throat of 3:1 bears 1.5 times the limit, and not 2.25 (cases/axisymmetric_throat).
constexpr double largest_viscous_share_about_axis = 0.5, acoustic_share_about_axis = 1 / 3.0;
/// Both together: sound that a viscosity damps, found half a step late, is a leapfrog that is stable up to
/// (omega dt)^2/4 + lambda dt/2 = 1, omega its frequency and lambda the rate of the damping. By the shares of
/// the limits at which either alone is unstable; a tenth is left.
constexpr double damped_sound_share = 0.9;

bool thins(const OptionalTerms& terms) {
  return viscosity_of(terms, 1e6) < viscosity_of(terms, 0);
}

/// Parabolas through the faces of walls answer more strongly than the fluid does, and more so where it
/// slides: in cases/abrasive_slip 1.4 was stable and 1.6 not with a slip length of half the width. Without
/// slip 1.37 is stable in cases/abrasive_slit/newtonian.toml at 40 across, and with 1.44 single particles get
/// twice and later four times as fast as the flow. 1.2 is taken there, over `damped_sound_share`. Of a medium
/// that thins the largest viscosity is not that at walls.
double viscous_edge(const Parameters& p) {
  if (p.wall_model.extrapolation != WallExtrapolation::fit || thins(p)) return 2.4;
  return p.wall_slip ? 1.45 : 1.33;
}

/// Steps of sound that is damped, of the edges of sound and of viscosity alone [s].
double damped_sound_limit(double sound, double viscosity) {
  const double half = 0.5 * sound * sound / viscosity;
  return std::sqrt(half * half + damped_sound_share * sound * sound) - half;
}

struct StepLimit {
  double value;  ///< [s]
  std::string_view rule;
};

/// Limits times the share of them that is taken. A term has a limit of its own if there is a function
/// `time_step_limit(term, medium)`.
StepLimit smallest_limit(const Parameters& p, const Medium& medium, const Extremes& largest,
                         Geometry geometry) {
  const double h = p.h();
  double nu = largest.viscosity / p.density;
  if (p.artificial_viscosity)
    nu += effective_kinematic_viscosity(p.artificial_viscosity->alpha, h, p.sound_speed);
  const double share = p.time_step_share;
  const bool in_plane = geometry == Geometry::plane;
  const double acoustic =
      acoustic_share * h /
      (p.sound_speed + std::max(largest.speed, largest.speed_of_turning) + largest.elastic_speed);
  StepLimit smallest{share * acoustic * (in_plane ? 1 : acoustic_share_about_axis), "acoustic"};
  const auto limit = [&](double value, std::string_view rule, double taken) {
    if (taken * value < smallest.value) smallest = {taken * value, rule};
  };
  if (nu > 0) {
    const double viscous = viscous_share * h * h / nu;
    limit(viscous, "viscous",
          std::min(share, in_plane ? largest_viscous_share : largest_viscous_share_about_axis));
    if (p.integrator == Integrator::symplectic && in_plane)
      limit(damped_sound_limit(time_step_edge(p) * acoustic, viscous_edge(p) * viscous),
            "acoustic and viscous", 1);
  }
  if (largest.acceleration > 0) limit(force_share * std::sqrt(h / largest.acceleration), "force", share);
  if (largest.friction_rate > 0)
    limit(friction_share / largest.friction_rate, "friction", std::min(share, largest_friction_share));
  if (largest.relaxation_rate > 0) limit(relaxation_share / largest.relaxation_rate, "relaxation", share);
  for_each_term(p, [&]<class Term>(const std::optional<Term>& term) {
    if constexpr (requires { time_step_limit(*term, medium); })
      if (term) limit(time_step_limit(*term, medium), Term::section, share);
  });
  return smallest;
}

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
void add_to_log_conformation(Particles& fluid, double dt) {
  for_each_log_conformation(
      fluid, [&](Field& psi, const Field& rate, std::size_t) { add(psi, dt, rate, fluid.clusters()); });
}

}  // namespace

WeaklyCompressible::WeaklyCompressible(const Parameters& parameters, const Scene& scene, Filled filled)
    : FluidModel(parameters, scene, filled),
      dynamics_(parameters, scene.gravity_at(0), kernel_, equation_of_state_, scene.geometry) {
  dynamics_.allocate(state_.fluid);
  if (parameters.particle_shifting)
    shifting_.emplace(*parameters.particle_shifting, parameters.spacing, kernel_);
  if (parameters.held_volume) start_volume_ = volume(state_.fluid);
  state_.balance = EnergyBalance(powers());
  state_.largest.viscosity = dynamics_.viscosity_at_rest();
  note_extremes();
}

double WeaklyCompressible::time_step_limit() const {
  return smallest_limit(parameters_, dynamics_.medium(), state_.largest, scene_.geometry).value;
}

std::string_view WeaklyCompressible::time_step_rule() const {
  return smallest_limit(parameters_, dynamics_.medium(), state_.largest, scene_.geometry).rule;
}

std::vector<Power> WeaklyCompressible::powers() {
  const ClusterList& neighbours = state_.neighbours.of_fluid();
  // Of a part there may be no particle; whether there were lists yet is alike on all ranks.
  const bool listed = ranks_ ? state_.neighbours.builds() > 0 : neighbours.clusters() > 0;
  if (!listed) return dynamics_.powers(state_.fluid, neighbours, state_.boundaries);
  // Pressures of the last evaluation are half a step older than the velocities. Where both swing, as sound
  // does, their product would be wrong by the step, always to the same side.
  Particles& fluid = state_.fluid;
  start_ = {};                                   // its memory is needed
  FoundValues before(fluid, state_.boundaries);  // as a step expects them
  Timers not_told;
  dynamics_.evaluate(RatesOf::both, fluid, neighbours, state_.boundaries, not_told, ranks_);
  std::vector<Power> found = dynamics_.powers(fluid, neighbours, state_.boundaries, ranks_);
  before.bring_back();
  return found;
}

void WeaklyCompressible::advance_from(const Start& start, double dt) {
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < state_.fluid.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    for (int a = 0; a < dim; ++a) {
      // x before v: its rate is the velocity of the evaluation, not the new one
      store(load(start.x[a], first) + dt * load(state_.fluid.v[a], first), state_.fluid.x[a], first);
      store(load(start.v[a], first) + dt * load(state_.fluid.a[a], first), state_.fluid.v[a], first);
    }
    store(load(start.rho, first) + dt * load(state_.fluid.drho, first), state_.fluid.rho, first);
    for_each_log_conformation(state_.fluid, [&](Field& psi, const Field& rate, std::size_t n) {
      store(load(start.log_conformation[n], first) + dt * load(rate, first), psi, first);
    });
  }
}

void WeaklyCompressible::advance(double dt) {
  update_neighbours(dt);
  if (parameters_.seeks_free_surface()) {
    const auto timer = timers_.measure("free surface");
    find_off_surface();
    if (state_.open_ends) state_.open_ends->exclude_from_corrections(state_.fluid);
    if (parameters_.keeps_off_walls()) find_off_surface_and_walls(state_.fluid, state_.boundaries, kernel_);
  }
  if (parameters_.integrator == Integrator::symplectic)
    step_symplectic(dt);
  else
    step_midpoint(dt);
  if (shifting_) shift(dt);
  if (parameters_.held_volume) hold_volume(state_.fluid, start_volume_, ranks_);
  note_extremes();
}

void WeaklyCompressible::evaluate(RatesOf wanted, double time) {
  if (scene_.gravity_change) dynamics_.set_gravity(scene_.gravity_at(time));
  if (state_.open_ends) state_.open_ends->impose(state_.fluid, time, scene_.gravity_at(time));
  dynamics_.evaluate(wanted, state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, timers_, ranks_);
  share_rates();
  if (state_.open_ends)
    state_.open_ends->take_rates(state_.fluid, wanted != RatesOf::density, wanted != RatesOf::velocity);
}

void WeaklyCompressible::share_rates() {
  if (!ranks_) return;
  Particles& fluid = state_.fluid;
  std::vector<Field*> rates{&fluid.a[0], &fluid.a[1], &fluid.drho};
  for_each_log_conformation(fluid, [&](Field&, Field& rate, std::size_t) { rates.push_back(&rate); });
  ranks_->share(rates);
}

void WeaklyCompressible::step_midpoint(double dt) {
  start_.x = state_.fluid.x, start_.v = state_.fluid.v, start_.rho = state_.fluid.rho;
  start_.log_conformation.clear();
  for_each_log_conformation(state_.fluid, [&](const Field& psi, const Field&, std::size_t) {
    start_.log_conformation.push_back(psi);
  });
  evaluate(RatesOf::both, state_.time);
  advance_from(start_, 0.5 * dt);
  move_boundaries(state_.time + 0.5 * dt);
  evaluate(RatesOf::both, state_.time + 0.5 * dt);
  accumulate_reaction(dt);
  const auto timer = timers_.measure("step");
  advance_from(start_, dt);
  state_.time += dt;
  move_boundaries(state_.time);
}

/// Beside the interface, whose velocity has changed.
void WeaklyCompressible::renew_density_rates() {
  const auto renew = [&](const std::vector<std::uint32_t>& clusters) {
    dynamics_.renew_density_rates(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, clusters);
  };
  if (!ranks_) return renew(state_.boundaries.back().list_for_fluid.active());
  const Renewal& of_part = ranks_->beside_interface();
  Field& drho = state_.fluid.drho;
  std::vector<double> kept;
  for (const auto i : of_part.kept) kept.push_back(drho[i]);
  renew(of_part.clusters);
  for (std::size_t k = 0; k < kept.size(); ++k) drho[of_part.kept[k]] = kept[k];
  share_rates();
}

void WeaklyCompressible::step_symplectic(double dt) {
  const std::size_t clusters = state_.fluid.clusters();
  if (!state_.density_rate_known || (state_.contact_changed && parameters_.consistent_gradients))
    evaluate(RatesOf::density, state_.time);
  else if (state_.contact_changed)
    renew_density_rates();
  state_.density_rate_known = true;
  state_.contact_changed = false;
  add(state_.fluid.x, 0.5 * dt, state_.fluid.v, clusters);
  add(state_.fluid.rho, 0.5 * dt, state_.fluid.drho, clusters);
  add_to_log_conformation(state_.fluid, 0.5 * dt);
  move_boundaries(state_.time + 0.5 * dt);
  evaluate(RatesOf::velocity, state_.time + 0.5 * dt);
  accumulate_reaction(dt);
  add(state_.fluid.v, dt, state_.fluid.a, clusters);
  add(state_.fluid.x, 0.5 * dt, state_.fluid.v, clusters);
  state_.time += dt;
  move_boundaries(state_.time);
  evaluate(RatesOf::density, state_.time);
  add(state_.fluid.rho, 0.5 * dt, state_.fluid.drho, clusters);
  add_to_log_conformation(state_.fluid, 0.5 * dt);
}

/// Notes what the forces of the evaluation by which the velocity advances do to others over `dt`.
void WeaklyCompressible::accumulate_reaction(double dt) {
  if (ranks_) ranks_->collect_forces(state_.boundaries);
  for (Boundary& boundary : state_.boundaries) {
    auto* interface = std::get_if<MovingInterface>(&boundary.motion);
    if (!interface && !boundary.turns()) continue;
    const auto timer = timers_.measure(interface ? "reaction on the interface" : "reaction on what turns");
    dynamics_.react(state_.fluid, pressure_offset(), boundary);
    if (ranks_) collect_at(boundary);
    if (interface) interface->add_load(boundary, boundary.force_on_fluid.force(), dt);
  }
  note_surface(dt);
  push_pressed_walls(dt);
  count_forces(dt);
  for (std::size_t b = 0; b < state_.boundaries.size(); ++b)
    if (Boundary& boundary = state_.boundaries[b]; boundary.turns())
      boundary.count_moment(dynamics_.moment_beside_pairs(state_.fluid, state_.boundaries, b, ranks_), dt);
}

void WeaklyCompressible::note_surface(double dt) {
  if (!state_.surface_record) return;
  const auto timer = timers_.measure("surface of the work pieces");
  const double p_offset = pressure_offset();
  for (Boundary& boundary : state_.boundaries)
    if (!boundary.is_interface() && !boundary.turns())  // which have reacted
      dynamics_.react_by_friction(state_.fluid, p_offset, boundary);
  SurfaceRecord& record = *state_.surface_record;
  auto found = record.find(state_.boundaries, state_.fluid, p_offset, state_.neighbours.of_fluid(), kernel_);
  if (!ranks_) return record.add(found, dt);
  record.collect(found, state_.boundaries, *ranks_);
  surface_found_ = std::move(found);
}

void WeaklyCompressible::shift(double dt) {
  const auto timer = timers_.measure("shifting");
  shifting_->shift(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, state_.largest.speed, dt);
  if (!ranks_) return;
  Particles& fluid = state_.fluid;
  std::vector<Field*> moved{&fluid.x[0], &fluid.x[1], &fluid.v[0], &fluid.v[1], &fluid.rho};
  for_each_log_conformation(fluid, [&](Field& psi, Field&, std::size_t) { moved.push_back(&psi); });
  ranks_->share(moved);
}

void WeaklyCompressible::note_extremes() {
  const Particles& fluid = state_.fluid;
  Extremes& largest = state_.largest;
  const auto of_all = [&](double value) { return ranks_ ? ranks_->largest(value) : value; };
  largest.speed = of_all(largest_norm(fluid.v, fluid.count));
  largest.acceleration = of_all(largest_norm(fluid.a, fluid.count));
  largest.speed_of_turning = 0;
  for (const Boundary& boundary : state_.boundaries)
    if (boundary.turns())
      largest.speed_of_turning = std::max(largest.speed_of_turning, largest_norm(boundary.v, boundary.count));
  if (dynamics_.viscosity_varies())
    largest.viscosity = ranks_ ? ranks_->largest(fluid.eta)
                               : *std::max_element(fluid.eta.begin(), fluid.eta.begin() + fluid.count);
  if (const auto& medium = parameters_.viscoelasticity) {
    const PolymerExtremes extremes = polymer_extremes(*medium, fluid);
    largest.elastic_speed = of_all(extremes.elastic_speed);
    largest.relaxation_rate = of_all(extremes.relaxation_rate);
  }
  if (const auto& friction = dynamics_.friction()) {
    const auto first = fluid.rho.begin();
    const double densest = of_all(std::accumulate(first, first + static_cast<std::ptrdiff_t>(fluid.count),
                                                  0.0, [](double a, double b) { return std::max(a, b); }));
    largest.friction_rate =
        friction->rate(equation_of_state_.pressure(densest) + pressure_offset(), parameters_.density);
  }
}

}  // namespace toryu::fluid
