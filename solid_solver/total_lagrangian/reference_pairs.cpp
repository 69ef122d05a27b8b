#include "solid_solver/total_lagrangian/reference_pairs.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace toryu::solid {

namespace {

/// A held particle beside a corner may have one free neighbour, or several in a row: it then has a gradient
/// along them alone. What the moment has of its larger eigenvalue across is nothing below this share.
constexpr double least_moment = 1e-3;

/// L of a lane, where the moment may be singular.
Tensor<double> pseudo_inverse(const Tensor<Lanes>& adjugate, std::size_t lane) {
  Mat M;
  M << adjugate[3][lane], -adjugate[1][lane], -adjugate[2][lane], adjugate[0][lane];
  Eigen::SelfAdjointEigenSolver<Mat> solver;
  solver.computeDirect(M);
  const Vec eigenvalues = solver.eigenvalues();
  Vec inverse = Vec::Zero();
  for (int a = 0; a < dim; ++a)
    if (eigenvalues[a] > least_moment * eigenvalues[dim - 1]) inverse[a] = 1.0 / eigenvalues[a];
  const Mat L = solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
  return {L(0, 0), L(0, 1), L(1, 0), L(1, 1)};
}

}  // namespace

ReferencePairs::ReferencePairs(const VecField& X, const Field& volume, std::size_t count, double h,
                               double strip_width, const std::optional<Held>& held, const Shape& shape,
                               const std::vector<Vec>& shifts)
    : X_(X) {
  StripOrder strips(strip_width);
  strips.index(X[0], count);
  const CubicSpline W(h);
  list_.build(X, count, X, strips, W.support(), shifts);
  share_start_.assign(list_.clusters(), none);
  std::optional<ClampFaces> faces;
  if (held) faces.emplace(X, count, *held, list_, W.support());
  resize(L_, X[0].size());

  weight_.resize(list_.pairs() * lane_count);
  std::size_t next = 0;
  for (std::size_t c = 0; c < list_.clusters(); ++c) {
    start_.push_back(next);
    for (const ShiftedNeighbours& near : list_.near(c)) next += lane_count * near.sources.size();
    if (faces) find_shares(*faces, c, count);
    const Moment moment = find_weights(volume, W, shape, c);
    const Lanes inverse_determinant = 1.0 / moment.determinant();
    const Tensor<Lanes> adjugate = moment.adjugate();
    for (std::size_t n = 0; n < adjugate.size(); ++n)
      store(adjugate[n] * inverse_determinant, L_[n], c * lane_count);
    for (std::size_t lane = 0; faces && lane < lane_count; ++lane) {
      const std::size_t i = c * lane_count + lane;
      if (!faces->holds(i)) continue;
      const Tensor<double> L = pseudo_inverse(adjugate, lane);
      for (std::size_t n = 0; n < L.size(); ++n) L_[n][i] = L[n];
    }
  }
}

void ReferencePairs::find_shares(const ClampFaces& faces, std::size_t cluster, std::size_t count) {
  std::vector<double> shares;
  bool beside_held = false;
  for (const ShiftedNeighbours& near : list_.near(cluster))
    for (const std::uint32_t j : near.sources)
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const auto s = faces.share(std::min(cluster * lane_count + lane, count - 1), j);
        beside_held |= s.has_value();
        shares.push_back(s.value_or(1.0));
      }
  if (!beside_held) return;
  share_start_[cluster] = share_.size();
  share_.insert(share_.end(), shares.begin(), shares.end());
}

Moment ReferencePairs::find_weights(const Field& volume, const CubicSpline& W, const Shape& shape,
                                    std::size_t cluster) {
  Moment moment;
  double* w = weight_.data() + start_[cluster];
  const double* s = share_start_[cluster] == none ? nullptr : share_.data() + share_start_[cluster];
  const double smallest = 1e-6 * W.h();
  for (const auto& [shift, sources] : list_.near(cluster)) {
    const Vec images = shift;
    over_sources(
        sources, shifted(load(X_, cluster * lane_count), shift), pointers(X_),
        [&](std::uint32_t j, const VecLanes& X_ij) TORYU_INLINE_LAMBDA {
          const Lanes R = square_root(dot(X_ij, X_ij)), share = s ? load(s) : Lanes(1.0);
          Lanes weight = volume[j] * W.gradient_over_r(R, inverse(max(R, smallest)));
          weight = select(R < smallest, 0.0, weight);
          weight = select(share > 0.0, weight / max(share * share, 1e-12), 0.0);
          store(weight, w);
          for (std::size_t lane = 0; lane < lane_count && !shape.is_convex(); ++lane)
            if (w[lane] != 0 && !shape.joins(at(X_, cluster * lane_count + lane) + images, at(X_, j)))
              w[lane] = 0;
          weight = load(w);
          w += lane_count;
          if (s) s += lane_count;
          const VecLanes sX_ij = product(share, X_ij);
          moment.add(product(weight, sX_ij), sX_ij);  // (w X) X rather than X (w X): other last bits
        });
  }
  return moment;
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

namespace {

/// How stiff the pair penalty of a cluster is: alike everywhere,
struct SameStiffness {
  double k;
  Lanes weighted(std::uint32_t /*j*/, const Lanes& weight) const { return weight; }
  Lanes times(const Lanes& sum) const { return k * sum; }
};
/// or the mean of both particles.
struct MeanStiffness {
  const double* k;
  Lanes k_i;
  Lanes weighted(std::uint32_t j, const Lanes& weight) const { return 0.5 * (k_i + k[j]) * weight; }
  Lanes times(const Lanes& sum) const { return sum; }
};

}  // namespace

template <class Stiffness>
TORYU_INLINE VecLanes ReferencePairs::force_density_of(const VecField& u, const Tensor<Field>& T,
                                                       std::size_t cluster,
                                                       const Stiffness& stiffness) const {
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
    add_product(penalty, stiffness.weighted(j, weight), difference(u_i, u_of, j));
  });
  return {f[0] + load(T[0], i) * wX_sum[0] + load(T[1], i) * wX_sum[1] + stiffness.times(penalty[0]),
          f[1] + load(T[2], i) * wX_sum[0] + load(T[3], i) * wX_sum[1] + stiffness.times(penalty[1])};
}

VecLanes ReferencePairs::force_density(const VecField& u, const Tensor<Field>& T, double k,
                                       std::size_t cluster) const {
  return force_density_of(u, T, cluster, SameStiffness{k});
}

VecLanes ReferencePairs::force_density(const VecField& u, const Tensor<Field>& T, const Field& k,
                                       std::size_t cluster) const {
  return force_density_of(u, T, cluster, MeanStiffness{k.data(), load(k, cluster * lane_count)});
}

Lanes ReferencePairs::unseen_motion(const VecField& u, const Tensor<Lanes>& H_i, std::size_t cluster) const {
  const std::size_t i = cluster * lane_count;
  const VecLanes u_i = load(u, i);
  const Positions u_of = pointers(u);
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
