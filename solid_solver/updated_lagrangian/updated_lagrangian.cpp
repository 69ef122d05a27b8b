#include "solid_solver/updated_lagrangian/updated_lagrangian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/run/snapshot.hpp"

namespace toryu::solid {

namespace {

/// How much further than the kernel the lists reach, over h. Wider lists are rarer and longer.
constexpr double skin_ratio = 0.15;

}  // namespace

UpdatedLagrangian::UpdatedLagrangian(const Parameters& parameters, const Body& body, const Scene& scene)
    : SolidModel(parameters, body, scene),
      sweeps_(parameters),
      law_{parameters.material.bulk_modulus(), parameters.material.shear_modulus(),
           parameters.material.density},
      strips_(strip_width()),
      skin_(skin_ratio * parameters.h()) {
  const std::size_t size = padded(particle_count());
  for (auto* field : {&state_.x, &state_.v, &u_start_, &v_start_, &x_listed_}) resize(*field, size);
  for (auto* field : {&state_.m, &state_.rho, &state_.V, &rates_.rho, &rho_start_}) field->resize(size, 0.0);
  for (auto* field : {&state_.s, &rates_.s, &rates_.R, &s_start_}) resize(*field, size);
  resize(rates_.T, size);
  for (std::size_t k = 0; k < size; ++k) {
    state_.m[k] = mass(number_[std::min(k, particle_count() - 1)]);
    state_.rho[k] = parameters.material.density;
  }
  find_neighbours();
#pragma omp parallel
  evaluate();
  watch_bonds();
}

void UpdatedLagrangian::save() {
  SolidModel::save();
  restore_ = snapshot(state_, x_listed_, strips_, list_);
}

void UpdatedLagrangian::restore() {
  SolidModel::restore();
  restore_();
}

void UpdatedLagrangian::advance(double dt) {
  find_neighbours_if_moved();
  {
    const auto scope = timers_.measure("steps");
    parameters_.integrator == Integrator::midpoint ? midpoint_step(dt) : symplectic_step(dt);
  }
  look_at_particles();
}

void UpdatedLagrangian::midpoint_step(double dt) {
#pragma omp parallel
  {
    keep_start();
    evaluate();
    move(0.5 * dt);
    evaluate();
    move(dt);
  }
  count_impulses(dt);
  time_ += dt;
}

void UpdatedLagrangian::symplectic_step(double dt) {
  time_ += dt;
  count_impulses(0.5 * dt);  // of the first kick
  const double kept = parameters_.damping ? parameters_.damping->factor(0.5 * dt) : 1.0;
#pragma omp parallel
  {
    kick(dt, kept, 1.0);
    drift(0.5 * dt);
    place(0.5 * dt);
    strain(dt);
    drift(0.5 * dt);
    place(0.0);
#pragma omp for schedule(static)
    for (std::size_t c = 0; c < clusters(); ++c) sweeps_.stresses(state_, list_, c, rates_);
    accelerate();
    kick(dt, 1.0, kept);
  }
  count_impulses(0.5 * dt);
}

void UpdatedLagrangian::find_neighbours_if_moved() {
  Lanes furthest = 0.0;
  for (std::size_t i = 0; i < X_[0].size(); i += lane_count) {
    Lanes squared = 0.0;
    for (int a = 0; a < dim; ++a) {
      const Lanes moved = load(X_[a], i) + load(u_[a], i) - load(x_listed_[a], i);
      squared += moved * moved;
    }
    furthest = max(furthest, squared);
  }
  // A step adds far less than the tenth of the skin that is left to it.
  const double allowed = 0.45 * skin_;
  if (largest_of(furthest) <= allowed * allowed) return;
  check(time_);  // particles flung to all ends would make the search take all memory
  find_neighbours();
}

void UpdatedLagrangian::find_neighbours() {
  const auto scope = timers_.measure("neighbour search");
  const auto find_positions = [&] {
    for (int a = 0; a < dim; ++a)
      for (std::size_t k = 0; k < X_[a].size(); ++k) state_.x[a][k] = X_[a][k] + u_[a][k];
  };
  find_positions();
  const auto order = strips_.sort(state_.x[0], state_.x[1], particle_count());
  reorder_particles(order);
  Field scratch;
  for (auto* field : {&state_.m, &state_.rho, &rates_.rho, &state_.s.xx, &state_.s.yy, &state_.s.xy})
    reorder(*field, order, scratch);
  find_positions();
  x_listed_ = state_.x;
  strips_.index(state_.x[0], particle_count());
  list_.build(state_.x, particle_count(), state_.x, strips_, 2.0 * parameters_.h() + skin_);
}

void UpdatedLagrangian::keep_start() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    store(load(u_, i), u_start_, i);
    store(load(v_, i), v_start_, i);
    store(load(state_.rho, i), rho_start_, i);
    store(load(state_.s, i), s_start_, i);
  }
}

void UpdatedLagrangian::place(double ahead) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    for (int a = 0; a < dim; ++a) {
      store(load(X_[a], i) + load(u_[a], i), state_.x[a], i);
      store(load(v_[a], i), state_.v[a], i);
    }
    store(load(state_.m, i) * inverse(load(state_.rho, i) + ahead * load(rates_.rho, i)), state_.V, i);
  }
}

void UpdatedLagrangian::evaluate() {
  place(0.0);
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) sweeps_.rates(state_, list_, c, rates_);
  accelerate();
}

void UpdatedLagrangian::accelerate() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c)
    store(sweeps_.acceleration(state_, rates_, list_, c), a_, c * lane_count);
  if (walls_) add_wall_contact(state_.x);
}

void UpdatedLagrangian::move(double dt) {
  const double rate = parameters_.damping ? parameters_.damping->rate : 0.0;
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a) {
      const Lanes v = load(v_[a], i);
      const Lanes dv = load(a_[a], i) + load(external_[a], i) - rate * v;
      store(load(u_start_[a], i) + dt * v, u_[a], i);
      store(load(v_start_[a], i) + dt * mobile * dv, v_[a], i);
    }
    store(load(rho_start_, i) + dt * load(rates_.rho, i), state_.rho, i);
    const Symmetric<Lanes> s = load(s_start_, i), ds = load(rates_.s, i);
    store({s.xx + dt * ds.xx, s.yy + dt * ds.yy, s.xy + dt * ds.xy}, state_.s, i);
  }
}

void UpdatedLagrangian::kick(double dt, double kept_before, double kept_after) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a) {
      const Lanes dv = 0.5 * dt * mobile * (load(a_[a], i) + load(external_[a], i));
      store(kept_after * (kept_before * load(v_[a], i) + dv), v_[a], i);
    }
  }
}

void UpdatedLagrangian::drift(double dt) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c)
    for (int a = 0; a < dim; ++a) {
      const std::size_t i = c * lane_count;
      store(load(u_[a], i) + dt * load(v_[a], i), u_[a], i);
    }
}

void UpdatedLagrangian::strain(double dt) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Tensor<Lanes> grad_v = sweeps_.velocity_gradient(state_, list_, c);
    const Lanes rho = load(state_.rho, i), half = 0.5 * dt * (grad_v[0] + grad_v[3]);
    const Lanes rho_after = rho * (1.0 - half) * inverse(1.0 + half);  // the same way back in time
    store(rho_after, state_.rho, i);
    store((rho_after - rho) * (1.0 / dt), rates_.rho, i);
    store(law_.after(load(state_.s, i), grad_v, dt), state_.s, i);
  }
}

std::pair<double, std::string_view> UpdatedLagrangian::limit() const {
  const double h = parameters_.h();
  double speed_2 = 0, acceleration_2 = 0;
  for (std::size_t k = 0; k < particle_count(); ++k) {
    speed_2 = std::max(speed_2, at(v_, k).squaredNorm());
    acceleration_2 = std::max(acceleration_2, (mobile_[k] * (at(a_, k) + at(external_, k))).squaredNorm());
  }
  std::pair<double, std::string_view> least{
      parameters_.courant_number * h / (parameters_.material.longitudinal_sound_speed() + std::sqrt(speed_2)),
      "acoustic"};
  if (parameters_.artificial_viscosity && parameters_.artificial_viscosity->alpha > 0) {
    const double nu =
        parameters_.artificial_viscosity->alpha * h * parameters_.material.bulk_sound_speed() / 8.0;
    least = std::min(least, {0.125 * h * h / nu, "viscous"});
  }
  if (acceleration_2 > 0) least = std::min(least, {0.25 * std::sqrt(h / std::sqrt(acceleration_2)), "force"});
  least.first *= parameters_.time_step_share;
  return least;
}

void UpdatedLagrangian::check_strain(double time) const {
  const double bound = parameters_.limits.strain, rho_0 = parameters_.material.density;
  for (std::size_t k = 0; k < particle_count(); ++k)
    if (!(std::abs(state_.rho[k] / rho_0 - 1.0) <= bound))
      fail(k, time, "density", fmt::format("{:.5g} kg/m3", state_.rho[k]),
           fmt::format("{:.5g} to {:.5g} kg/m3", std::max(1.0 - bound, 0.0) * rho_0, (1.0 + bound) * rho_0));
}

Stress UpdatedLagrangian::stress(std::size_t particle) const {
  const std::size_t k = slot_[particle];
  const double p = law_.pressure(state_.rho[k]);
  return {state_.s.xx[k] - p, state_.s.yy[k] - p, -(state_.s.xx[k] + state_.s.yy[k]) - p, state_.s.xy[k]};
}

std::vector<Observation> UpdatedLagrangian::internal_energies() const {
  double sum = 0;
  for (std::size_t k = 0; k < particle_count(); ++k)
    sum += state_.m[k] / state_.rho[k] *
           law_.energy(state_.rho[k], {state_.s.xx[k], state_.s.yy[k], state_.s.xy[k]});
  return {{"elastic_energy", "J/m", sum}};
}

std::vector<ActiveTerm> UpdatedLagrangian::active_terms() const {
  const auto& material = parameters_.material;
  const bool renormalised = parameters_.gradients == Gradients::renormalised;
  std::vector<ActiveTerm> terms;
  terms.push_back(
      {"updated Lagrangian stress",
       renormalised ? "Dv_i/Dt = sum_j m_j (sigma_i L_i/rho_i^2 + sigma_j L_j/rho_j^2) gradW_ij"
                    : "Dv_i/Dt = sum_j m_j (sigma_i/rho_i^2 + sigma_j/rho_j^2) gradW_ij",
       "thesis eq. 22",
       fmt::format("h {:g} m, {}", parameters_.h(),
                   parameters_.integrator == Integrator::midpoint ? "midpoint steps of two evaluations"
                                                                  : "symplectic steps of one evaluation")});
  terms.push_back(
      {"Hooke's law with the Jaumann rate",
       "p = K (rho/rho_0 - 1), Ds/Dt = 2 G dev(e') + s omega^T + omega s, plane strain",
       "Gray, Monaghan & Swift 2001; thesis eq. 5-8",
       fmt::format("E {:g} Pa, nu {:g}: K {:.4g} Pa, G {:.4g} Pa, c_L {:.4g} m/s", material.youngs_modulus,
                   material.poissons_ratio, law_.K, law_.G, material.longitudinal_sound_speed())});
  if (parameters_.artificial_stress)
    terms.push_back({"artificial stress",
                     "R'_k = -epsilon sigma'_k/rho^2 where tensile, times (W_ij/W(d0))^n",
                     "Gray, Monaghan & Swift 2001; thesis eq. 25-26",
                     fmt::format("epsilon {:g}, n {}", parameters_.artificial_stress->epsilon,
                                 parameters_.artificial_stress->exponent)});
  for (auto& term : SolidModel::active_terms()) terms.push_back(std::move(term));
  return terms;
}

}  // namespace toryu::solid
