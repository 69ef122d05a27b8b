#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

#include <fmt/format.h>

#include <cmath>

namespace toryu {

namespace {

using toryu::square_root;

double square_root(double a) {
  return std::sqrt(a);
}

/// Larger principal value of C = F^T F, the square of the largest stretch; `smaller` receives the other one.
template <class T>
T largest_principal(const Tensor<T>& H, T& smaller) {
  const Symmetric<T> E = green_lagrange_strain(H);
  const T mean = E.xx + E.yy, difference = E.xx - E.yy;
  const T D = square_root(T(difference * difference + 4.0 * E.xy * E.xy));
  smaller = 1.0 + mean - D;
  return 1.0 + mean + D;
}

}  // namespace

TotalLagrangian::TotalLagrangian(const SolidParameters& parameters, const SolidBody& body, const Scene& scene)
    : SolidModel(parameters, body, scene),
      material_{parameters.material.lame_lambda(), parameters.material.shear_modulus()},
      penalty_(parameters.hourglass ? parameters.hourglass->coefficient * parameters.material.youngs_modulus
                                    : 0.0) {
  const std::size_t size = padded(particle_count());
  volume_.resize(size);
  for (std::size_t k = 0; k < size; ++k)
    volume_[k] = body_.volume(number_[std::min(k, particle_count() - 1)]);
  pairs_ = std::make_unique<ReferencePairs>(X_, volume_, particle_count(), parameters_.h(), strip_width());
  resize(H_, size);
  resize(T_, size);
  find_highest_frequency();
  if (walls_) resize(x_, size);
#pragma omp parallel
  evaluate();
}

void TotalLagrangian::advance(double dt) {
  const auto scope = timers_.measure("steps");
  time_ += dt;
  count_impulses(0.5 * dt);  // of the first kick
#pragma omp parallel
  {
    kick_and_drift(dt);
    evaluate();
    kick(dt);
  }
  count_impulses(0.5 * dt);
  look_for_detached();
}

void TotalLagrangian::kick_and_drift(double dt) {
  const double kept = parameters_.damping ? parameters_.damping->factor(0.5 * dt) : 1.0;
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const Lanes mobile = load(mobile_, i);
    for (int a = 0; a < dim; ++a) {
      const Lanes v = kept * load(v_[a], i) + 0.5 * dt * mobile * (load(a_[a], i) + load(external_[a], i));
      store(v, v_[a], i);
      store(load(u_[a], i) + dt * v, u_[a], i);
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
      store(kept * (load(v_[a], i) + 0.5 * dt * mobile * (load(a_[a], i) + load(external_[a], i))), v_[a], i);
  }
}

void TotalLagrangian::evaluate() {
  find_stresses();
  find_accelerations();
  if (!x_[0].empty()) touch_walls();
}

void TotalLagrangian::touch_walls() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c)
    for (int a = 0; a < dim; ++a) {
      const std::size_t i = c * lane_count;
      store(load(X_[a], i) + load(u_[a], i), x_[a], i);
    }
  add_wall_contact(x_);
}

void TotalLagrangian::find_stresses() {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    Tensor<Lanes> H;
    pairs_->displacement_gradient(u_, c, H);
    const Tensor<Lanes> T = product(material_.stress(H), pairs_->shape(c));
    store(H, H_, c * lane_count);
    for (std::size_t n = 0; n < H.size(); ++n) store(T[n] - 0.5 * penalty_ * H[n], T_[n], c * lane_count);
  }
}

void TotalLagrangian::find_accelerations() {
  const double inverse_rho = 1.0 / parameters_.material.density;
  const auto& viscosity = parameters_.artificial_viscosity;
  const PairViscosity Pi =
      pair_viscosity(viscosity.value_or(ArtificialViscosity{}), parameters_.material, parameters_.h());
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    VecLanes a = pairs_->force_density(u_, T_, penalty_, c);
    for (int k = 0; k < dim; ++k) a[k] *= inverse_rho;
    if (viscosity) {
      const VecLanes damped = pairs_->central_force_density(u_, v_, c, Pi);
      for (int k = 0; k < dim; ++k) a[k] -= parameters_.material.density * damped[k];
    }
    store(a, a_, c * lane_count);
  }
}

void TotalLagrangian::find_highest_frequency() {
  // Power iteration on u -> -a(u) about the unloaded body, from a start that holds all modes.
  const double small = 1e-6 * body_.spacing;
  VecField start = u_;
  const VecField velocity = v_;
  for (std::size_t k = 0; k < particle_count(); ++k)
    for (int a = 0; a < dim; ++a) {
      u_[a][k] = small * mobile_[k] * std::cos(static_cast<double>((3 + a) * k * k));
      v_[a][k] = 0.0;
    }
  double square = 0;
  for (int n = 0; n < 150; ++n) {
#pragma omp parallel
    evaluate();
    double length = 0, image = 0;
    for (int a = 0; a < dim; ++a)
      for (std::size_t k = 0; k < particle_count(); ++k) {
        length += u_[a][k] * u_[a][k];
        const double value = mobile_[k] * a_[a][k];
        image += value * value;
      }
    if (!(image > 0)) break;
    square = std::sqrt(image / length);
    const double scale = std::sqrt(length / image);
    for (int a = 0; a < dim; ++a)
      for (std::size_t k = 0; k < particle_count(); ++k) u_[a][k] = -scale * mobile_[k] * a_[a][k];
  }
  highest_frequency_ = std::sqrt(square);
  u_ = start;
  v_ = velocity;
}

double TotalLagrangian::largest_stretch_squared() const {
  double largest = 1.0;
  for (std::size_t i = 0; i < particle_count(); i += lane_count) {
    Lanes smaller;
    const Lanes square = largest_principal(load(H_, i), smaller);
    // idle lanes stand still among particles that move: what they hold is no stretch
    for (std::size_t lane = 0; lane < std::min(lane_count, particle_count() - i); ++lane)
      largest = std::max(largest, square[lane]);
  }
  return largest;
}

double TotalLagrangian::time_step_limit() const {
  const double contact = walls_ ? walls_->highest_frequency() : 0.0;
  const double stiffening_squared = 1.5 * largest_stretch_squared() - 0.5;
  const double frequency =
      std::sqrt(stiffening_squared * highest_frequency_ * highest_frequency_ + contact * contact);
  if (frequency == 0) return 1.0;  // all held: nothing moves
  const double damping =
      parameters_.artificial_viscosity ? 1.0 + parameters_.artificial_viscosity->alpha : 1.0;
  return parameters_.time_step_share * 2.0 / (frequency * damping);
}

Tensor<double> TotalLagrangian::gradient(std::size_t slot) const {
  return {H_[0][slot], H_[1][slot], H_[2][slot], H_[3][slot]};
}

void TotalLagrangian::check_strain(double time) const {
  const double longest = 1.0 + parameters_.limits.strain,
               shortest = std::max(1.0 - parameters_.limits.strain, 0.0);
  for (std::size_t i = 0; i < particle_count(); i += lane_count) {
    Lanes smaller;
    const Tensor<Lanes> H = load(H_, i);
    const Lanes larger = largest_principal(H, smaller);
    const Lanes J = (1.0 + H[0]) * (1.0 + H[3]) - H[1] * H[2];
    if (all_of((larger <= longest * longest) & (smaller >= shortest * shortest) & (J > 0.0))) continue;
    for (std::size_t k = i; k < std::min(i + lane_count, particle_count()); ++k) {
      double least;
      const Tensor<double> H_k = gradient(k);
      const double most = largest_principal(H_k, least);
      const double J_k = (1.0 + H_k[0]) * (1.0 + H_k[3]) - H_k[1] * H_k[2];
      if (!(most <= longest * longest && least >= shortest * shortest && J_k > 0.0))
        fail(k, time, "stretch",
             fmt::format("{:.4g} to {:.4g}, volume ratio {:.4g}", std::sqrt(least), std::sqrt(most), J_k),
             fmt::format("{:.4g} to {:.4g}, above 0", shortest, longest));
    }
  }
}

Stress TotalLagrangian::stress(std::size_t particle) const {
  const Tensor<double> H = gradient(slot_[particle]);
  const Tensor<double> F{1.0 + H[0], H[1], H[2], 1.0 + H[3]}, F_T{F[0], F[2], F[1], F[3]};
  const double J = F[0] * F[3] - F[1] * F[2];
  const Symmetric<double> E = green_lagrange_strain(H);
  const Tensor<double> sigma = product(material_.stress(H), F_T);
  return {sigma[0] / J, sigma[3] / J, material_.lambda * (E.xx + E.yy) / J, sigma[1] / J};
}

std::vector<Observation> TotalLagrangian::internal_energies() const {
  double elastic = 0, penalty = 0;
  for (std::size_t c = 0; c < clusters(); ++c) {
    const Lanes unseen = pairs_->unseen_motion(u_, H_, c);
    for (std::size_t lane = 0; lane < lane_count && c * lane_count + lane < particle_count(); ++lane) {
      const std::size_t k = c * lane_count + lane;
      elastic += volume_[k] * material_.energy(green_lagrange_strain(gradient(k)));
      penalty += volume_[k] * 0.25 * penalty_ * unseen[lane];
    }
  }
  return {{"elastic_energy", "J/m", elastic}, {"hourglass_energy", "J/m", penalty}};
}

std::vector<ActiveTerm> TotalLagrangian::active_terms() const {
  const auto& material = parameters_.material;
  std::vector<ActiveTerm> terms;
  terms.push_back(
      {"total Lagrangian stress", "rho_0 V_i Dv_i/Dt = sum_j V_i V_j (P_i L_i + P_j L_j) gradW_ij",
       "Rabczuk, Belytschko & Xiao 2004; L: Randles & Libersky 1996",
       fmt::format("h {:g} m, leapfrog, highest frequency {:.4g} 1/s", parameters_.h(), highest_frequency_)});
  terms.push_back({"St. Venant-Kirchhoff", "S = lambda tr(E) I + 2 G E, plane strain", "",
                   fmt::format("E {:g} Pa, nu {:g}: K {:.4g} Pa, G {:.4g} Pa, c_L {:.4g} m/s",
                               material.youngs_modulus, material.poissons_ratio, material.bulk_modulus(),
                               material.shear_modulus(), material.longitudinal_sound_speed())});
  if (parameters_.hourglass)
    terms.push_back({"hourglass penalty",
                     "f_i = -(alpha E/2) V_i sum_j V_j k_ij (2 x_ij - (F_i + F_j) X_ij), k_ij = -W'/R_ij",
                     "after Ganzenmueller 2015",
                     fmt::format("alpha {:g}", parameters_.hourglass->coefficient)});
  for (auto& term : SolidModel::active_terms()) terms.push_back(std::move(term));
  return terms;
}

}  // namespace toryu
