#include "solid_solver/terms/body_contact.hpp"

#include <algorithm>
#include <limits>

#include "common/sph/sorted_points.hpp"

namespace toryu::solid {

TouchingBodies::TouchingBodies(const VecField& X, const Field& volume, std::size_t count, const Contact& term,
                               const ElasticMaterial& material, double spacing, double h)
    : V_(volume),
      count_(count),
      W_(h),
      pressure_scale_(term.stiffness * material.bulk_modulus()),
      inverse_rho_(1.0 / material.density),
      skin_(0.5 * h),
      S_(count, 0.0) {
  S_0_ = half_plane(W_, spacing, spacing).sum;
  // Pressed in by half a spacing. Both sides push, and both move: four times the stiffness at a wall.
  highest_frequency_ =
      2.0 * half_plane(W_, spacing, 0.5 * spacing).slope * std::sqrt(pressure_scale_ * inverse_rho_ / S_0_);
  find_bodies(points(X));
}

std::vector<Vec> TouchingBodies::points(const VecField& x) const {
  std::vector<Vec> result(count_);
  for (std::size_t k = 0; k < count_; ++k) result[k] = at(x, k);
  return result;
}

void TouchingBodies::find_bodies(const std::vector<Vec>& X) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  const SortedPoints sorted(X, W_.support());
  body_.assign(count_, none);
  for (std::uint32_t first = 0; first < count_; ++first) {
    if (body_[first] != none) continue;
    const auto body = static_cast<std::uint32_t>(bodies_++);
    std::vector<std::uint32_t> front{first};
    body_[first] = body;
    while (!front.empty()) {
      const std::uint32_t i = front.back();
      front.pop_back();
      sorted.near(X[i], W_.support(), [&](std::uint32_t j) {
        if (body_[j] != none) return;
        body_[j] = body;
        front.push_back(j);
      });
    }
  }
}

void TouchingBodies::find_pairs_if_moved(const VecField& x) {
  double moved_2 = x_listed_.empty() ? std::numeric_limits<double>::infinity() : 0.0;
  for (std::size_t k = 0; k < x_listed_.size(); ++k)
    moved_2 = std::max(moved_2, (at(x, k) - x_listed_[k]).squaredNorm());
  if (moved_2 < 0.25 * skin_ * skin_) return;
  x_listed_ = points(x);
  pairs_.clear();
  const double reach = W_.support() + skin_;
  const SortedPoints sorted(x_listed_, reach);
  for (std::uint32_t i = 0; i < count_; ++i)
    sorted.near(x_listed_[i], reach, [&](std::uint32_t j) {
      if (i < j && body_[i] != body_[j]) pairs_.push_back({i, j});
    });
}

double TouchingBodies::pressure(std::size_t i) const {
  return pressure_scale_ * std::max(0.0, S_[i] / S_0_ - 1.0);
}

void TouchingBodies::push(const VecField& x, VecField& a) {
  find_pairs_if_moved(x);
  std::fill(S_.begin(), S_.end(), 0.0);
  for (const auto& [i, j] : pairs_) {
    const double W = W_.value((at(x, i) - at(x, j)).norm());
    S_[i] += V_[j] * W;
    S_[j] += V_[i] * W;
  }
  for (const auto& [i, j] : pairs_) {
    const double p = pressure(i) + pressure(j);
    if (p == 0.0) continue;
    const Vec x_ij = at(x, i) - at(x, j);
    const double r = std::max(x_ij.norm(), 1e-8 * W_.h());
    const Vec f = -inverse_rho_ * p * W_.gradient_over_r(r, 1.0 / r) * x_ij;
    set(a, i, at(a, i) + V_[j] * f);
    set(a, j, at(a, j) - V_[i] * f);
  }
}

double TouchingBodies::energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < count_; ++i)
    sum += V_[i] * 0.5 * S_0_ / pressure_scale_ * pressure(i) * pressure(i);
  return sum;
}

}  // namespace toryu::solid
