#include "solid_solver/terms/body_contact.hpp"

#include <algorithm>
#include <limits>

#include "common/sph/skin.hpp"
#include "common/sph/sorted_points.hpp"

namespace toryu::solid {

TouchingBodies::TouchingBodies(const VecField& X, const Field& volume, std::size_t count, const Contact& term,
                               const ElasticMaterial& material, double spacing, double h, const Shape& shape,
                               const std::vector<Vec>& shifts)
    : V_(volume),
      count_(count),
      shifts_(shifts),
      W_(h),
      pressure_scale_(term.pressure_scale(material)),
      skin_(0.5 * h) {
  S_0_ = half_plane(W_, spacing, spacing).sum;
  // Pressed in by half a spacing. Both sides push, and both move: four times the stiffness at a wall.
  const double inverse_rho = 1.0 / material.density;
  highest_frequency_ =
      2.0 * half_plane(W_, spacing, 0.5 * spacing).slope * std::sqrt(pressure_scale_ * inverse_rho / S_0_);
  find_bodies(points(X), shape);
}

std::vector<Vec> TouchingBodies::points(const VecField& x) const {
  std::vector<Vec> result(count_);
  for (std::size_t k = 0; k < count_; ++k) result[k] = at(x, k);
  return result;
}

void TouchingBodies::find_bodies(const std::vector<Vec>& X, const Shape& shape) {
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
      for (const Vec& shift : shifts_)
        sorted.near(X[i] + shift, W_.support(), [&](std::uint32_t j) {
          if (body_[j] != none || !shape.joins(X[i] + shift, X[j])) return;
          body_[j] = body;
          front.push_back(j);
        });
    }
  }
}

void TouchingBodies::find_pairs_if_moved(State& state, const VecField& x) const {
  if (!state.x_listed[0].empty()) {
    const double moved = largest_distance(x, state.x_listed, count_);
    if (!skin_exhausted(moved, moved, skin_)) return;
  }
  state.x_listed = x;
  find_pairs(state);
}

void TouchingBodies::find_pairs(State& state) const {
  state.pairs.clear();
  const double reach = W_.support() + skin_;
  const std::vector<Vec> listed = points(state.x_listed);
  const SortedPoints sorted(listed, reach);
  for (std::uint32_t i = 0; i < count_; ++i)
    for (const Vec& shift : shifts_)
      sorted.near(listed[i] + shift, reach, [&](std::uint32_t j) {
        if (i < j && body_[i] != body_[j]) state.pairs.push_back({i, j, shift});
      });
}

double TouchingBodies::pressure(const State& state, std::size_t i) const {
  return pressure_scale_ * std::max(0.0, state.S[i] / S_0_ - 1.0);
}

void TouchingBodies::push(State& state, const VecField& x, const Field& inverse_rho, VecField& a) const {
  find_pairs_if_moved(state, x);
  state.S.assign(count_, 0.0);
  for (const Pair& pair : state.pairs) {
    const double W = W_.value(pair.between(x).norm());
    state.S[pair.i] += V_[pair.j] * W;
    state.S[pair.j] += V_[pair.i] * W;
  }
  for (const Pair& pair : state.pairs) {
    const auto [i, j, shift] = pair;
    const double p = pressure(state, i) + pressure(state, j);
    if (p == 0.0) continue;
    const Vec x_ij = pair.between(x);
    const double r = std::max(x_ij.norm(), 1e-8 * W_.h());
    const auto f = [&](double inverse_rho_k) -> Vec {
      return -inverse_rho_k * p * W_.gradient_over_r(r, 1.0 / r) * x_ij;
    };
    set(a, i, at(a, i) + V_[j] * f(inverse_rho[i]));
    set(a, j, at(a, j) - V_[i] * f(inverse_rho[j]));
  }
}

double TouchingBodies::energy(const State& state) const {
  double sum = 0;
  for (std::size_t i = 0; i < count_; ++i)
    sum += V_[i] * 0.5 * S_0_ / pressure_scale_ * pressure(state, i) * pressure(state, i);
  return sum;
}

}  // namespace toryu::solid
