#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/state/serialize.hpp"

namespace toryu::solid {

TotalLagrangian::TotalLagrangian(const Parameters& parameters, const Body& body, const Scene& scene)
    : SolidModel(parameters, body, scene),
      composition_(parameters, body_, state_.number, padded(particle_count())) {
  const std::size_t size = padded(particle_count());
  volume_.resize(size);
  VecField cells;
  resize(cells, size);
  for (std::size_t k = 0; k < size; ++k) {
    const std::uint32_t i = state_.number[std::min(k, particle_count() - 1)];
    volume_[k] = body_.volume(i);
    set(cells, k, body_.cell[i]);
  }
  const Held held{mobile_, cells, body_.has_outline()};
  pairs_ = std::make_unique<ReferencePairs>(X_, volume_, particle_count(), parameters_.h(), strip_width(),
                                            held, body_.shape, body_.shifts);
  composition_.find_laminates(X_, particle_count(), held, volume_, *pairs_,
                              CubicSpline(parameters_.h()).support());
  resize_fields(form_, size);
  resize(T_, size);
  if (drive_.turns()) resize(turned_back_, size);
  find_recovered_points();
  highest_frequency_ = find_highest_frequency();
  if (parameters_.body_contact)
    bodies_.emplace(X_, volume_, particle_count(), *parameters_.body_contact,
                    parameters_.material_in_contact(), body_.spacing, parameters_.h(), body_.shape,
                    body_.shifts);
  if (!walls_ && !bodies_) return;
  resize(x_, size);
#pragma omp parallel
  evaluate();
}

void TotalLagrangian::save() {
  SolidModel::save();
  saved_form_ = form_;
}

void TotalLagrangian::restore() {
  SolidModel::restore();
  form_ = saved_form_;
  if (drive_.turns()) turn_back();
}

void TotalLagrangian::write_state(std::ostream& stream) const {
  SolidModel::write_state(stream);
  write_states(stream, form_);
}

void TotalLagrangian::read_state(std::istream& stream) {
  SolidModel::read_state(stream);
#pragma omp parallel
  find_stresses();  // of the displacement, which H alone depends on
  read_states(stream, form_);
}

void TotalLagrangian::advance(double dt) {
  const auto scope = timers_.measure("steps");
  begin_drive(dt);
  state_.time += dt;
  brake_by_impedance(dt, parameters_.damping ? parameters_.damping->factor(0.5 * dt) : 1.0);
  count_impulses(0.5 * dt);  // of the first kick
#pragma omp parallel
  {
    kick_and_drift(dt);
    if (!drive_.clamps().empty()) {
#pragma omp single
      move_clamps();
    }
    evaluate();
    kick(dt);
  }
  move_clamps();  // whose velocity damping has changed
  count_impulses(0.5 * dt);
  end_drive();
  end_step();
}

void TotalLagrangian::kick_and_drift(double dt) {
  const double kept = parameters_.damping ? parameters_.damping->factor(0.5 * dt) : 1.0;
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a) {
      const Lanes v = kept * load(state_.v[a], i) +
                      0.5 * dt * mobile * (load(state_.a[a], i) + load(state_.external[a], i));
      store(v, state_.v[a], i);
      store(load(state_.u[a], i) + dt * v, state_.u[a], i);
    }
  }
}

void TotalLagrangian::kick(double dt) {
  const double kept = parameters_.damping ? parameters_.damping->factor(0.5 * dt) : 1.0;
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a)
      store(kept * (load(state_.v[a], i) +
                    0.5 * dt * mobile * (load(state_.a[a], i) + load(state_.external[a], i))),
            state_.v[a], i);
  }
}

void TotalLagrangian::evaluate() {
  find_stresses();
  find_accelerations();
  if (!x_[0].empty()) touch();
}

void TotalLagrangian::touch() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) place_in_domain(x_, c);
  if (walls_) add_wall_contact(x_);
#pragma omp single
  if (bodies_) bodies_->push(state_.bodies, x_, inverse_rho_, state_.a);
}

void TotalLagrangian::turn_back() {
  const Mat back = drive_.pose(state_.time).rotation.transpose();
#pragma omp for schedule(static)
  for (std::size_t k = 0; k < X_[0].size(); ++k) {
    const Vec X = at(X_, k);
    set(turned_back_, k, back * (X + at(state_.u, k)) - X);
  }
}

template <class Stress>
void TotalLagrangian::find_stresses_by(const Stress& stress) {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    Tensor<Lanes> H;
    pairs_->displacement_gradient(seen(), c, H);
    Tensor<Lanes> strained = H;  // what is held bears no stress
    for (Lanes& component : strained) component *= load(mobile_, i);
    if (!all_of(volume_change(strained) > -1.0)) record_inverted(strained, i);
    const Tensor<Lanes> T = product(stress(c, strained), pairs_->shape(c));
    store(strained, form_.H, i);
    const Lanes k = load(composition_.penalty(), i);
    for (std::size_t n = 0; n < H.size(); ++n) store(T[n] - 0.5 * k * H[n], T_[n], i);
  }
}

void TotalLagrangian::find_stresses() {
  if (drive_.turns()) turn_back();
  if (!composition_.is_uniform())
    return find_stresses_by([&](std::size_t c, const Tensor<Lanes>& H) { return composition_.stress(c, H); });
  std::visit(
      [&](const auto& law) {
        find_stresses_by([&](std::size_t, const Tensor<Lanes>& H)
                             TORYU_INLINE_LAMBDA { return law.stress(H); });
      },
      composition_.law(0));
}

void TotalLagrangian::record_inverted(const Tensor<Lanes>& H, std::size_t first_slot) {
#pragma omp critical
  for (std::size_t k = first_slot; k < std::min(first_slot + lane_count, particle_count()); ++k) {
    const double J = 1.0 + volume_change(H)[k - first_slot];
    if (J > 0.0) continue;
    const bool earlier = !form_.inverted || (form_.inverted->time == state_.time && k < form_.inverted->slot);
    if (earlier) form_.inverted = Inverted{k, state_.time, J};
  }
}

VecLanes TotalLagrangian::viscous(std::size_t cluster) const {
  const Field &rho = composition_.density(), &c = composition_.sound_speed();
  const double alpha = parameters_.artificial_viscosity->alpha, beta = parameters_.artificial_viscosity->beta;
  if (composition_.is_uniform()) {
    const PairViscosity<> Pi{alpha * c[0], beta, parameters_.h(), 1.0 / rho[0]};
    return pairs_->central_force_density(state_.u, state_.v, cluster,
                                         [&](std::uint32_t, const Lanes& v_dot_x, const Lanes& r_squared)
                                             TORYU_INLINE_LAMBDA { return Pi(v_dot_x, r_squared); });
  }
  const Lanes rho_i = load(rho, cluster * lane_count), c_i = load(c, cluster * lane_count);
  return pairs_->central_force_density(
      state_.u, state_.v, cluster, [&](std::uint32_t j, const Lanes& v_dot_x, const Lanes& r_squared) {
        const PairViscosity<Lanes> Pi{alpha * 0.5 * (c_i + c[j]), beta, parameters_.h(),
                                      2.0 / (rho_i + rho[j])};
        return rho[j] / rho_i * Pi(v_dot_x, r_squared);
      });
}

void TotalLagrangian::find_accelerations() {
  const Mat R = drive_.pose(state_.time).rotation;
  const Field& k_of = composition_.penalty();
  const bool uniform = composition_.is_uniform();
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    VecLanes a =
        uniform ? pairs_->force_density(seen(), T_, k_of[0], c) : pairs_->force_density(seen(), T_, k_of, c);
    if (drive_.turns()) a = {R(0, 0) * a[0] + R(0, 1) * a[1], R(1, 0) * a[0] + R(1, 1) * a[1]};
    for (int k = 0; k < dim; ++k) a[k] *= load(inverse_rho_, i);
    if (parameters_.artificial_viscosity) {
      const VecLanes damped = viscous(c);
      for (int k = 0; k < dim; ++k) a[k] -= load(composition_.density(), i) * damped[k];
    }
    store(a, state_.a, i);
  }
}

double TotalLagrangian::find_highest_frequency() {
  // Power iteration on u -> -(a(u) - a), from a start that holds all modes.
  const double small = 1e-6 * body_.spacing;
  const VecField u = state_.u, v = state_.v;
  VecField step = state_.u;
  for (std::size_t k = 0; k < particle_count(); ++k)
    for (int n = 0; n < dim; ++n) {
      step[n][k] = small * mobile_[k] * std::cos(static_cast<double>((3 + n) * k * k));
      state_.v[n][k] = 0.0;
    }
#pragma omp parallel
  evaluate();
  const VecField a = state_.a;
  double square = 0;
  for (int round = 0; round < 150; ++round) {
    for (int n = 0; n < dim; ++n)
      for (std::size_t k = 0; k < particle_count(); ++k) state_.u[n][k] = u[n][k] + step[n][k];
#pragma omp parallel
    evaluate();
    double length = 0, image = 0;
    for (int n = 0; n < dim; ++n)
      for (std::size_t k = 0; k < particle_count(); ++k) {
        length += step[n][k] * step[n][k];
        step[n][k] = -mobile_[k] * (state_.a[n][k] - a[n][k]);
        image += step[n][k] * step[n][k];
      }
    if (!(image > 0)) break;
    square = std::sqrt(image / length);
    const double scale = std::sqrt(length / image);
    for (auto& component : step)
      for (double& value : component) value *= scale;
  }
  state_.u = u;
  state_.v = v;
#pragma omp parallel
  evaluate();
  return std::sqrt(square);
}

double TotalLagrangian::time_step_limit() const {
  const double contact =
      std::hypot(walls_ ? walls_->highest_frequency() : 0.0, bodies_ ? bodies_->highest_frequency() : 0.0);
  const double frequency =
      std::sqrt(composition_.stiffening(form_.H, particle_count()) * highest_frequency_ * highest_frequency_ +
                contact * contact);
  if (frequency == 0) return 1.0;  // all held: nothing moves
  const double damping =
      parameters_.artificial_viscosity ? 1.0 + parameters_.artificial_viscosity->alpha : 1.0;
  return parameters_.time_step_share * 2.0 / (frequency * damping);
}

Tensor<double> TotalLagrangian::gradient(std::size_t slot) const {
  if (!drive_.turns()) return {form_.H[0][slot], form_.H[1][slot], form_.H[2][slot], form_.H[3][slot]};
  Mat F;
  F << 1.0 + form_.H[0][slot], form_.H[1][slot], form_.H[2][slot], 1.0 + form_.H[3][slot];
  const Mat H = drive_.pose(state_.time).rotation * F - Mat::Identity();
  return {H(0, 0), H(0, 1), H(1, 0), H(1, 1)};
}

void TotalLagrangian::check_strain(double time) const {
  if (form_.inverted)
    fail(form_.inverted->slot, form_.inverted->time, "volume ratio",
         fmt::format("{:.4g}", form_.inverted->volume_ratio),
         std::isnan(form_.inverted->volume_ratio) ? "above 0; a row one particle thick has no gradient across"
                                                  : "above 0");
  const double longest = 1.0 + parameters_.limits.strain,
               shortest = std::max(1.0 - parameters_.limits.strain, 0.0);
  const auto within_limits = [&](const auto& stretches) {
    return (stretches.larger_squared <= longest * longest) &
           (stretches.smaller_squared >= shortest * shortest);
  };
  for (std::size_t i = 0; i < particle_count(); i += lane_count) {
    if (all_of(within_limits(principal_stretches(load(form_.H, i))))) continue;
    for (std::size_t k = i; k < std::min(i + lane_count, particle_count()); ++k) {
      const auto stretches = principal_stretches(gradient(k));
      if (within_limits(stretches)) continue;
      fail(k, time, "stretch",
           fmt::format("{:.4g} to {:.4g}", std::sqrt(stretches.smaller_squared),
                       std::sqrt(stretches.larger_squared)),
           fmt::format("{:.4g} to {:.4g}", shortest, longest));
    }
  }
}

std::vector<Observation> TotalLagrangian::internal_energies() const {
  double elastic = 0, penalty = 0;
  for (std::size_t c = 0; c < clusters(); ++c) {
    Tensor<Lanes> H;  // of the held particles too, whose pairs it fits
    pairs_->displacement_gradient(seen(), c, H);
    const Lanes unseen = pairs_->unseen_motion(seen(), H, c);
    for (std::size_t lane = 0; lane < lane_count && c * lane_count + lane < particle_count(); ++lane) {
      const std::size_t k = c * lane_count + lane;
      elastic += volume_[k] * composition_.energy(k, gradient(k));
      penalty += volume_[k] * 0.25 * composition_.penalty()[k] * unseen[lane];
    }
  }
  return {{"elastic_energy", "J/m", elastic}, {"hourglass_energy", "J/m", penalty}};
}

std::vector<ActiveTerm> TotalLagrangian::active_terms() const {
  std::vector<ActiveTerm> terms;
  terms.push_back(
      {"total Lagrangian stress", "rho_0 V_i Dv_i/Dt = sum_j V_i V_j (P_i L_i + P_j L_j) gradW_ij",
       "Rabczuk, Belytschko & Xiao 2004; L: Randles & Libersky 1996",
       fmt::format("h {:g} m, leapfrog, highest frequency {:.4g} 1/s", parameters_.h(), highest_frequency_)});
  for (std::size_t m = 0; m < composition_.materials().size(); ++m)
    if (composition_.uses(m)) terms.push_back(active_law(composition_.materials()[m]));
  if (parameters_.hourglass)
    terms.push_back(
        {"hourglass penalty", "f_i = -(k/2) V_i sum_j V_j w_ij (2 x_ij - (F_i + F_j) X_ij), w_ij = -W'/R_ij",
         "after Ganzenmueller 2015",
         fmt::format("alpha {:g}: k {}", parameters_.hourglass->coefficient,
                     composition_.is_uniform() ? fmt::format("{:.4g} Pa", composition_.penalty()[0])
                                               : "of each material")});
  if (!composition_.laminates().empty())
    terms.push_back({"bonded materials", "[P_1(H - phi c N) - P_2(H + (1 - phi) c N)] N = 0",
                     "laminates of rank one: Milton 2002",
                     fmt::format("{} particles see another material", composition_.laminates().size())});
  for (auto& term : SolidModel::active_terms()) terms.push_back(std::move(term));
  return terms;
}

}  // namespace toryu::solid
