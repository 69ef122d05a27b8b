#include "solid_solver/total_lagrangian/reference_pairs.hpp"

#include <cmath>

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
    const VecLanes X_i = load(X, i);
    Lanes M_xx = 0.0, M_xy = 0.0, M_yy = 0.0;
    for (const std::uint32_t j : list_.sources(c)) {
      const VecLanes X_ij{X_i[0] - X[0][j], X_i[1] - X[1][j]};
      const Lanes R = square_root(dot(X_ij, X_ij));
      Lanes weight = volume[j] * W.gradient_over_r(R, inverse(max(R, Lanes(1e-6 * h))));
      weight = select(R < 1e-6 * h, 0.0, weight);
      store(weight, w);
      w += lane_count;
      M_xx -= weight * X_ij[0] * X_ij[0];
      M_xy -= weight * X_ij[0] * X_ij[1];
      M_yy -= weight * X_ij[1] * X_ij[1];
    }
    const Lanes inverse_determinant = 1.0 / (M_xx * M_yy - M_xy * M_xy);
    const Lanes L_xy = -M_xy * inverse_determinant;
    store({M_yy * inverse_determinant, L_xy, L_xy, M_xx * inverse_determinant}, L_, i);
  }
}

Tensor<Lanes> ReferencePairs::shape(std::size_t cluster) const {
  return load(L_, cluster * lane_count);
}

void ReferencePairs::displacement_gradient(const VecField& u, std::size_t cluster, Tensor<Lanes>& H) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes X_i = load(X_, i), u_i = load(u, i);
  Tensor<Lanes> sum{0.0, 0.0, 0.0, 0.0};
  const double* w = weight_.data() + start_[cluster];
  for (const std::uint32_t j : list_.sources(cluster)) {
    const Lanes weight = load(w);
    w += lane_count;
    const VecLanes wX{weight * (X_i[0] - X_[0][j]), weight * (X_i[1] - X_[1][j])};
    const VecLanes u_ij{u_i[0] - u[0][j], u_i[1] - u[1][j]};
    sum[0] -= u_ij[0] * wX[0];
    sum[1] -= u_ij[0] * wX[1];
    sum[2] -= u_ij[1] * wX[0];
    sum[3] -= u_ij[1] * wX[1];
  }
  H = product(sum, shape(cluster));
}

VecLanes ReferencePairs::force_density(const VecField& u, const Tensor<Field>& T, double k,
                                       std::size_t cluster) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes X_i = load(X_, i), u_i = load(u, i);
  VecLanes wX_sum{0.0, 0.0}, f{0.0, 0.0}, penalty{0.0, 0.0};
  const double* w = weight_.data() + start_[cluster];
  for (const std::uint32_t j : list_.sources(cluster)) {
    const Lanes weight = load(w);
    w += lane_count;
    const VecLanes wX{weight * (X_i[0] - X_[0][j]), weight * (X_i[1] - X_[1][j])};
    wX_sum[0] += wX[0];
    wX_sum[1] += wX[1];
    f[0] += T[0][j] * wX[0] + T[1][j] * wX[1];
    f[1] += T[2][j] * wX[0] + T[3][j] * wX[1];
    penalty[0] += weight * (u_i[0] - u[0][j]);
    penalty[1] += weight * (u_i[1] - u[1][j]);
  }
  return {f[0] + load(T[0], i) * wX_sum[0] + load(T[1], i) * wX_sum[1] + k * penalty[0],
          f[1] + load(T[2], i) * wX_sum[0] + load(T[3], i) * wX_sum[1] + k * penalty[1]};
}

Lanes ReferencePairs::unseen_motion(const VecField& u, const Tensor<Field>& H, std::size_t cluster) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes X_i = load(X_, i), u_i = load(u, i);
  const Tensor<Lanes> H_i = load(H, i);
  Lanes sum = 0.0;
  const double* w = weight_.data() + start_[cluster];
  for (const std::uint32_t j : list_.sources(cluster)) {
    const VecLanes X_ij{X_i[0] - X_[0][j], X_i[1] - X_[1][j]};
    const VecLanes unseen{u_i[0] - u[0][j] - H_i[0] * X_ij[0] - H_i[1] * X_ij[1],
                          u_i[1] - u[1][j] - H_i[2] * X_ij[0] - H_i[3] * X_ij[1]};
    sum -= load(w) * dot(unseen, unseen);
    w += lane_count;
  }
  return sum;
}

}  // namespace toryu::solid
