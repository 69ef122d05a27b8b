#include "solid_solver/total_lagrangian/reference_pairs.hpp"

#include <cmath>

#include "common/sph/renormalisation.hpp"

namespace toryu::solid {

ReferencePairs::ReferencePairs(const VecField& X, const Field& volume, std::size_t count, double h,
                               double strip_width)
    : X_(X) {
  StripOrder strips(strip_width);
  strips.index(X[0], count);
  const CubicSpline W(h);
  list_.build(X, count, X, strips, W.support());
  resize(L_, X[0].size());

  weight_.resize(list_.pairs() * lane_count);
  double* w = weight_.data();
  for (std::size_t c = 0; c < list_.clusters(); ++c) {
    start_.push_back(static_cast<std::size_t>(w - weight_.data()));
    const std::size_t i = c * lane_count;
    Moment moment;
    over_sources(list_.sources(c), load(X, i), pointers(X),
                 [&](std::uint32_t j, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
                   const Lanes R = square_root(dot(X_ij, X_ij));
                   Lanes weight = volume[j] * W.gradient_over_r(R, inverse(max(R, Lanes(1e-6 * h))));
                   weight = select(R < 1e-6 * h, 0.0, weight);
                   store(weight, w);
                   w += lane_count;
                   moment.add(product(weight, X_ij), X_ij);  // (w X) X rather than X (w X): other last bits
                 });
    const Lanes inverse_determinant = 1.0 / moment.determinant();
    Tensor<Lanes> L = moment.adjugate();
    for (Lanes& component : L) component *= inverse_determinant;
    store(L, L_, i);
  }
}

Tensor<Lanes> ReferencePairs::shape(std::size_t cluster) const {
  return load(L_, cluster * lane_count);
}

void ReferencePairs::displacement_gradient(const VecField& u, std::size_t cluster, Tensor<Lanes>& H) const {
  const VecLanes u_i = load(u, cluster * lane_count);
  const Positions u_of = pointers(u);
  Tensor<Lanes> sum{0.0, 0.0, 0.0, 0.0};
  over_pairs(cluster, [&](std::uint32_t j, const Lanes& weight, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
    const VecLanes wX = product(weight, X_ij), u_ij = difference(u_i, u_of, j);
    sum[0] -= u_ij[0] * wX[0];
    sum[1] -= u_ij[0] * wX[1];
    sum[2] -= u_ij[1] * wX[0];
    sum[3] -= u_ij[1] * wX[1];
  });
  H = product(sum, shape(cluster));
}

VecLanes ReferencePairs::force_density(const VecField& u, const Tensor<Field>& T, double k,
                                       std::size_t cluster) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes u_i = load(u, i);
  const Positions u_of = pointers(u);
  const double *T_xx = T[0].data(), *T_xy = T[1].data(), *T_yx = T[2].data(), *T_yy = T[3].data();
  VecLanes wX_sum = zero_vector(), f = zero_vector(), penalty = zero_vector();
  over_pairs(cluster, [&](std::uint32_t j, const Lanes& weight, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
    const VecLanes wX = product(weight, X_ij);
    for (int a = 0; a < dim; ++a) wX_sum[a] += wX[a];
    f[0] += T_xx[j] * wX[0] + T_xy[j] * wX[1];
    f[1] += T_yx[j] * wX[0] + T_yy[j] * wX[1];
    add_product(penalty, weight, difference(u_i, u_of, j));
  });
  return {f[0] + load(T[0], i) * wX_sum[0] + load(T[1], i) * wX_sum[1] + k * penalty[0],
          f[1] + load(T[2], i) * wX_sum[0] + load(T[3], i) * wX_sum[1] + k * penalty[1]};
}

Lanes ReferencePairs::unseen_motion(const VecField& u, const Tensor<Field>& H, std::size_t cluster) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes u_i = load(u, i);
  const Positions u_of = pointers(u);
  const Tensor<Lanes> H_i = load(H, i);
  Lanes sum = 0.0;
  over_pairs(cluster, [&](std::uint32_t j, const Lanes& weight, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
    const VecLanes u_ij = difference(u_i, u_of, j);
    const VecLanes unseen{u_ij[0] - H_i[0] * X_ij[0] - H_i[1] * X_ij[1],
                          u_ij[1] - H_i[2] * X_ij[0] - H_i[3] * X_ij[1]};
    sum -= weight * dot(unseen, unseen);
  });
  return sum;
}

}  // namespace toryu::solid
