#include "solid_solver/terms/wall_contact.hpp"

#include <cmath>
#include <numeric>

namespace toryu::solid {

namespace {

/// Largest squared distance between the first `count` points of both.
double largest_move_squared(const VecField& a, const VecField& b, std::size_t count) {
  double largest = 0;
  for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, (at(a, k) - at(b, k)).squaredNorm());
  return largest;
}

}  // namespace

ContactWalls::ContactWalls(const std::vector<Wall>& walls, const Contact& term,
                           const ElasticMaterial& material, double spacing, double h)
    : walls_(walls),
      W_(h),
      spacing_(spacing),
      pressure_scale_(term.stiffness * material.bulk_modulus()),
      inverse_rho_(1.0 / material.density),
      skin_(0.3 * h),
      strips_(std::sqrt(static_cast<double>(lane_count)) * spacing) {
  const double slope = half_plane(W_, spacing, 0.5 * spacing).slope;  // pressed in by half a spacing
  S_0_ = half_plane(W_, spacing, spacing).sum;
  highest_frequency_ = slope * std::sqrt(pressure_scale_ * inverse_rho_ / S_0_);
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (const Vec& X : fill({walls_[w].box}, {}, spacing)) {
      X_.push_back(X);
      wall_of_.push_back(w);
    }
  number_.resize(X_.size());
  std::iota(number_.begin(), number_.end(), 0u);
  resize(x_, padded(X_.size()));
}

void ContactWalls::place(double time) {
  std::vector<Vec> moved(walls_.size(), Vec::Zero());
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].motion) moved[w] = walls_[w].motion->displacement_at(time);
  for (std::size_t k = 0; k < number_.size(); ++k) set(x_, k, X_[number_[k]] + moved[wall_of_[number_[k]]]);
}

void ContactWalls::prepare(const VecField& x, std::size_t count, double time) {
  place(time);
  if (!solid_listed_[0].empty()) {
    const double solid = std::sqrt(largest_move_squared(x, solid_listed_, count));
    const double walls = std::sqrt(largest_move_squared(x_, x_listed_, number_.size()));
    if (solid + walls < 0.9 * skin_) return;
  }
  const auto order = strips_.sort(x_[0], x_[1], number_.size());
  std::vector<std::uint32_t> number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) number[k] = number_[order[k]];
  number_ = number;
  place(time);
  x_listed_ = x_;
  solid_listed_ = x;
  strips_.index(x_[0], number_.size());
  list_.build(x, count, x_, strips_, W_.support() + skin_);
}

Lanes ContactWalls::overlap(const VecField& x, std::size_t cluster, VecLanes& gradient) const {
  const VecLanes x_i = load(x, cluster * lane_count);
  const double V = spacing_ * spacing_, tiny = 1e-16 * W_.h() * W_.h();
  Lanes S = 0.0;
  gradient = {0.0, 0.0};
  for (const std::uint32_t w : list_.sources(cluster)) {
    const VecLanes x_iw{x_i[0] - x_[0][w], x_i[1] - x_[1][w]};
    const Lanes r_squared = dot(x_iw, x_iw) + tiny, inverse_r = inverse_sqrt(r_squared),
                r = r_squared * inverse_r;
    const Lanes slope = V * W_.gradient_over_r(r, inverse_r);
    S += V * W_.value(r);
    gradient[0] += slope * x_iw[0];
    gradient[1] += slope * x_iw[1];
  }
  return S;
}

VecLanes ContactWalls::acceleration(const VecField& x, std::size_t cluster) const {
  VecLanes gradient;
  const Lanes S = overlap(x, cluster, gradient);
  const Lanes p = pressure_scale_ * positive_part(S * (1.0 / S_0_) - 1.0);
  return {-inverse_rho_ * p * gradient[0], -inverse_rho_ * p * gradient[1]};
}

Lanes ContactWalls::energy_density(const VecField& x, std::size_t cluster) const {
  VecLanes gradient;
  const Lanes beyond = positive_part(overlap(x, cluster, gradient) * (1.0 / S_0_) - 1.0);
  return 0.5 * pressure_scale_ * S_0_ * beyond * beyond;
}

}  // namespace toryu::solid
