#include "solid_solver/updated_lagrangian/updated_lagrangian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/sph/skin.hpp"
#include "common/state/serialize.hpp"

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
      skin_(skin_ratio * parameters.h()) {
  const std::size_t size = padded(particle_count());
  resize_fields(form_.particles, size);
  resize_fields(form_.rates, size);
  resize_fields(form_, size);
  resize_fields(start_, size);
  std::fill(form_.particles.rho.begin(), form_.particles.rho.end(), parameters.material.density);
  find_neighbours();
#pragma omp parallel
  evaluate();
  watch_bonds();
}

void UpdatedLagrangian::find_masses() {
  for (std::size_t k = 0; k < form_.particles.m.size(); ++k)
    form_.particles.m[k] = mass(state_.number[std::min(k, particle_count() - 1)]);
}

void UpdatedLagrangian::save() {
  SolidModel::save();
  saved_form_ = form_;
}

void UpdatedLagrangian::restore() {
  SolidModel::restore();
  form_ = saved_form_;
}

void UpdatedLagrangian::write_state(std::ostream& stream) const {
  SolidModel::write_state(stream);
  write_states(stream, form_);
}

void UpdatedLagrangian::read_state(std::istream& stream) {
  SolidModel::read_state(stream);
  read_states(stream, form_);
  find_masses();
  list_neighbours();
}

void UpdatedLagrangian::advance(double dt) {
  find_neighbours_if_moved();
  {
    const auto scope = timers_.measure("steps");
    const bool kicks = parameters_.integrator != Integrator::midpoint;
    brake_by_impedance(dt, kicks && parameters_.damping ? parameters_.damping->factor(0.5 * dt) : 1.0);
    parameters_.integrator == Integrator::midpoint ? midpoint_step(dt) : symplectic_step(dt);
  }
  end_step();
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
  state_.time += dt;
}

void UpdatedLagrangian::symplectic_step(double dt) {
  state_.time += dt;
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
    for (std::size_t c = 0; c < clusters(); ++c)
      sweeps_.stresses(form_.particles, form_.list, c, form_.rates);
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
      const Lanes moved = load(X_[a], i) + load(state_.u[a], i) - load(form_.x_listed[a], i);
      squared += moved * moved;
    }
    furthest = max(furthest, squared);
  }
  // A step adds far less than the tenth of the skin that is left to it.
  const double moved = std::sqrt(largest_of(furthest));
  if (!skin_exhausted(moved, moved, 0.9 * skin_)) return;
  check(state_.time);  // particles flung to all ends would make the search take all memory
  find_neighbours();
}

void UpdatedLagrangian::find_neighbours() {
  const auto scope = timers_.measure("neighbour search");
  const auto note_positions = [&] {
    for (int a = 0; a < dim; ++a)
      for (std::size_t k = 0; k < X_[a].size(); ++k) form_.x_listed[a][k] = X_[a][k] + state_.u[a][k];
  };
  note_positions();
  const auto order = StripOrder(strip_width()).sort(form_.x_listed[0], form_.x_listed[1], particle_count());
  sort_particles(order);
  reorder_fields(form_.particles, order);
  reorder_fields(form_.rates, order);
  find_masses();
  note_positions();
  list_neighbours();
}

void UpdatedLagrangian::list_neighbours() {
  StripOrder strips(strip_width());
  strips.index(form_.x_listed[0], particle_count());
  form_.list.build(form_.x_listed, particle_count(), form_.x_listed, strips, 2.0 * parameters_.h() + skin_);
}

void UpdatedLagrangian::keep_start() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    store(load(state_.u, i), start_.u, i);
    store(load(state_.v, i), start_.v, i);
    store(load(form_.particles.rho, i), start_.rho, i);
    store(load(form_.particles.s, i), start_.s, i);
  }
}

void UpdatedLagrangian::place(double ahead) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    for (int a = 0; a < dim; ++a) {
      store(load(X_[a], i) + load(state_.u[a], i), form_.particles.x[a], i);
      store(load(state_.v[a], i), form_.particles.v[a], i);
    }
    store(
        load(form_.particles.m, i) * inverse(load(form_.particles.rho, i) + ahead * load(form_.rates.rho, i)),
        form_.particles.V, i);
  }
}

void UpdatedLagrangian::evaluate() {
  place(0.0);
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) sweeps_.rates(form_.particles, form_.list, c, form_.rates);
  accelerate();
}

void UpdatedLagrangian::accelerate() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c)
    store(sweeps_.acceleration(form_.particles, form_.rates, form_.list, c), state_.a, c * lane_count);
  if (walls_) add_wall_contact(form_.particles.x);
}

void UpdatedLagrangian::move(double dt) {
  const double rate = parameters_.damping ? parameters_.damping->rate : 0.0;
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a) {
      const Lanes v = load(state_.v[a], i);
      const Lanes dv = load(state_.a[a], i) + load(state_.external[a], i) - rate * v;
      store(load(start_.u[a], i) + dt * v, state_.u[a], i);
      store(load(start_.v[a], i) + dt * mobile * dv, state_.v[a], i);
    }
    store(load(start_.rho, i) + dt * load(form_.rates.rho, i), form_.particles.rho, i);
    const Symmetric<Lanes> s = load(start_.s, i), ds = load(form_.rates.s, i);
    store({s.xx + dt * ds.xx, s.yy + dt * ds.yy, s.xy + dt * ds.xy}, form_.particles.s, i);
  }
}

void UpdatedLagrangian::kick(double dt, double kept_before, double kept_after) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a) {
      const Lanes dv = 0.5 * dt * mobile * (load(state_.a[a], i) + load(state_.external[a], i));
      store(kept_after * (kept_before * load(state_.v[a], i) + dv), state_.v[a], i);
    }
  }
}

void UpdatedLagrangian::drift(double dt) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c)
    for (int a = 0; a < dim; ++a) {
      const std::size_t i = c * lane_count;
      store(load(state_.u[a], i) + dt * load(state_.v[a], i), state_.u[a], i);
    }
}

void UpdatedLagrangian::strain(double dt) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Tensor<Lanes> grad_v = sweeps_.velocity_gradient(form_.particles, form_.list, c);
    const Lanes rho = load(form_.particles.rho, i), half = 0.5 * dt * (grad_v[0] + grad_v[3]);
    const Lanes rho_after = rho * (1.0 - half) * inverse(1.0 + half);  // the same way back in time
    store(rho_after, form_.particles.rho, i);
    store((rho_after - rho) * (1.0 / dt), form_.rates.rho, i);
    store(law_.after(load(form_.particles.s, i), grad_v, dt), form_.particles.s, i);
  }
}

std::pair<double, std::string_view> UpdatedLagrangian::limit() const {
  const double h = parameters_.h();
  double speed_2 = 0, acceleration_2 = 0;
  for (std::size_t k = 0; k < particle_count(); ++k) {
    speed_2 = std::max(speed_2, at(state_.v, k).squaredNorm());
    acceleration_2 =
        std::max(acceleration_2, (mobile_[k] * (at(state_.a, k) + at(state_.external, k))).squaredNorm());
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
    if (!(std::abs(form_.particles.rho[k] / rho_0 - 1.0) <= bound))
      fail(k, time, "density", fmt::format("{:.5g} kg/m3", form_.particles.rho[k]),
           fmt::format("{:.5g} to {:.5g} kg/m3", std::max(1.0 - bound, 0.0) * rho_0, (1.0 + bound) * rho_0));
}

Stress UpdatedLagrangian::stress(std::size_t particle) const {
  const std::size_t k = slot_[particle];
  const double p = law_.pressure(form_.particles.rho[k]);
  return {form_.particles.s.xx[k] - p, form_.particles.s.yy[k] - p,
          -(form_.particles.s.xx[k] + form_.particles.s.yy[k]) - p, form_.particles.s.xy[k]};
}

std::vector<Observation> UpdatedLagrangian::internal_energies() const {
  double sum = 0;
  for (std::size_t k = 0; k < particle_count(); ++k)
    sum += form_.particles.m[k] / form_.particles.rho[k] *
           law_.energy(form_.particles.rho[k],
                       {form_.particles.s.xx[k], form_.particles.s.yy[k], form_.particles.s.xy[k]});
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
       "Monaghan 1992; thesis eq. 22",
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
