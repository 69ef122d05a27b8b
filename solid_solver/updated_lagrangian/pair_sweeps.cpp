#include "solid_solver/updated_lagrangian/pair_sweeps.hpp"

#include "common/sph/neighbour_loop.hpp"
#include "common/sph/renormalisation.hpp"

namespace toryu::solid {

namespace {

/// Determinant of sum_j V_j (x_j - x_i) (x) gradW_ij below which it is not inverted. It is 1 inside a lattice
/// and about 0.3 at its corners.
constexpr double near_singular = 0.05;

Tensor<Lanes> shape(const Moment& moment) {
  const auto regular = moment.determinant() > near_singular;
  const Lanes scale = inverse(max(moment.determinant(), Lanes(near_singular)));
  Tensor<Lanes> L = moment.adjugate();
  for (std::size_t n = 0; n < L.size(); ++n)
    L[n] = select(regular, L[n] * scale, n == 0 || n == 3 ? 1.0 : 0.0);
  return L;
}

Lanes power(const Lanes& a, int n) {
  Lanes result = a;
  for (int k = 1; k < n; ++k) result *= a;
  return result;
}

}  // namespace

PairSweeps::PairSweeps(const Parameters& parameters)
    : W_(parameters.h()),
      tiny_(1e-16 * parameters.h() * parameters.h()),
      law_{parameters.material.bulk_modulus(), parameters.material.shear_modulus(),
           parameters.material.density},
      renormalised_(parameters.gradients == Gradients::renormalised),
      stress_(parameters.artificial_stress),
      inverse_W_d0_(1.0 / W_.value(parameters.spacing)) {
  if (parameters.artificial_viscosity)
    viscosity_ = pair_viscosity(*parameters.artificial_viscosity, parameters.material, parameters.h());
}

void PairSweeps::rates(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
                       UpdatedRates& rates) const {
  const std::size_t i = cluster * lane_count;
  Tensor<Lanes> grad_v, L{1.0, 0.0, 0.0, 1.0};
  sweep(particles, list, cluster, grad_v, L);
  store(-load(particles.rho, i) * (grad_v[0] + grad_v[3]), rates.rho, i);
  store(law_.rate(load(particles.s, i), grad_v), rates.s, i);
  store_stresses(particles, L, cluster, rates);
}

Tensor<Lanes> PairSweeps::velocity_gradient(const UpdatedParticles& particles, const ClusterList& list,
                                            std::size_t cluster) const {
  Tensor<Lanes> grad_v, L{1.0, 0.0, 0.0, 1.0};
  sweep(particles, list, cluster, grad_v, L);
  return grad_v;
}

void PairSweeps::stresses(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
                          UpdatedRates& rates) const {
  Tensor<Lanes> grad_v, L{1.0, 0.0, 0.0, 1.0};
  if (renormalised_) sweep(particles, list, cluster, grad_v, L);
  store_stresses(particles, L, cluster, rates);
}

void PairSweeps::sweep(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
                       Tensor<Lanes>& grad_v, Tensor<Lanes>& L) const {
  renormalised_ ? sweep<true>(particles, list, cluster, grad_v, L)
                : sweep<false>(particles, list, cluster, grad_v, L);
}

template <bool renormalised>
void PairSweeps::sweep(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
                       Tensor<Lanes>& grad_v, Tensor<Lanes>& L) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes v_i = load(particles.v, i);
  const Positions v = pointers(particles.v);
  const double* V = particles.V.data();
  Moment moment;
  grad_v = {0.0, 0.0, 0.0, 0.0};
  over_sources(list.sources(cluster), load(particles.x, i), pointers(particles.x),
               [&](std::uint32_t j, const VecLanes& x_ij) TORYU_INLINE_LAMBDA {
                 const VecLanes v_ij = difference(v_i, v, j);
                 const Lanes r_squared = dot(x_ij, x_ij) + tiny_, inverse_r = inverse_sqrt(r_squared);
                 const Lanes weight = V[j] * W_.gradient_over_r(Lanes(r_squared * inverse_r), inverse_r);
                 const VecLanes V_gradW = product(weight, x_ij);
                 grad_v[0] -= v_ij[0] * V_gradW[0];
                 grad_v[1] -= v_ij[0] * V_gradW[1];
                 grad_v[2] -= v_ij[1] * V_gradW[0];
                 grad_v[3] -= v_ij[1] * V_gradW[1];
                 if constexpr (renormalised) moment.add(x_ij, V_gradW);
               });
  if constexpr (renormalised) {
    L = shape(moment);
    grad_v = product(grad_v, L);
  }
}

void PairSweeps::store_stresses(const UpdatedParticles& particles, const Tensor<Lanes>& L,
                                std::size_t cluster, UpdatedRates& rates) const {
  const std::size_t i = cluster * lane_count;
  const Lanes rho = load(particles.rho, i), p = law_.pressure(rho), inverse_rho_squared = inverse(rho * rho);
  const Symmetric<Lanes> s = load(particles.s, i), sigma{s.xx - p, s.yy - p, s.xy};
  Tensor<Lanes> T = sigma.full();
  if (renormalised_) T = product(T, L);
  for (auto& component : T) component *= inverse_rho_squared;
  store(T, rates.T, i);
  if (stress_) store(artificial_stress(sigma, inverse_rho_squared, stress_->epsilon), rates.R, i);
}

VecLanes PairSweeps::acceleration(const UpdatedParticles& particles, const UpdatedRates& rates,
                                  const ClusterList& list, std::size_t cluster) const {
  if (viscosity_)
    return stress_ ? acceleration_of<true, true>(particles, rates, list, cluster)
                   : acceleration_of<true, false>(particles, rates, list, cluster);
  return stress_ ? acceleration_of<false, true>(particles, rates, list, cluster)
                 : acceleration_of<false, false>(particles, rates, list, cluster);
}

template <bool viscous, bool stressed>
VecLanes PairSweeps::acceleration_of(const UpdatedParticles& particles, const UpdatedRates& rates,
                                     const ClusterList& list, std::size_t cluster) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes v_i = load(particles.v, i);
  const Positions v = pointers(particles.v);
  const Tensor<Lanes> T_i = load(rates.T, i);
  Symmetric<Lanes> R_i{0.0, 0.0, 0.0};
  if constexpr (stressed) R_i = load(rates.R, i);
  VecLanes a = zero_vector();
  over_sources(list.sources(cluster), load(particles.x, i), pointers(particles.x),
               [&](std::uint32_t j, const VecLanes& x_ij) TORYU_INLINE_LAMBDA {
                 const Lanes r_squared = dot(x_ij, x_ij) + tiny_, inverse_r = inverse_sqrt(r_squared),
                             r = r_squared * inverse_r;
                 const Lanes weight = particles.m[j] * W_.gradient_over_r(r, inverse_r);
                 Tensor<Lanes> T{T_i[0] + rates.T[0][j], T_i[1] + rates.T[1][j], T_i[2] + rates.T[2][j],
                                 T_i[3] + rates.T[3][j]};
                 if constexpr (viscous) {
                   const Lanes Pi = (*viscosity_)(dot(difference(v_i, v, j), x_ij), r_squared);
                   T[0] -= Pi;
                   T[3] -= Pi;
                 }
                 if constexpr (stressed) {
                   const Lanes F_n = power(Lanes(W_.value(r) * inverse_W_d0_), stress_->exponent);
                   const Lanes R_xy = (R_i.xy + rates.R.xy[j]) * F_n;
                   T[0] += (R_i.xx + rates.R.xx[j]) * F_n;
                   T[1] += R_xy;
                   T[2] += R_xy;
                   T[3] += (R_i.yy + rates.R.yy[j]) * F_n;
                 }
                 a[0] += weight * (T[0] * x_ij[0] + T[1] * x_ij[1]);
                 a[1] += weight * (T[2] * x_ij[0] + T[3] * x_ij[1]);
               });
  return a;
}

}  // namespace toryu::solid
