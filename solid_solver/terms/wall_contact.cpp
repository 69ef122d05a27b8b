#include "solid_solver/terms/wall_contact.hpp"

#include <cmath>
#include <numeric>

#include "common/scene/fill.hpp"
#include "common/sph/neighbour_loop.hpp"
#include "common/sph/skin.hpp"

namespace toryu::solid {

namespace {

StripOrder strips_of(double spacing) {
  return StripOrder(std::sqrt(static_cast<double>(lane_count)) * spacing);
}

}  // namespace

ContactWalls::ContactWalls(const std::vector<Wall>& walls, const Contact& term,
                           const ElasticMaterial& material, double spacing, double h, const Period& period)
    : walls_(walls),
      period_(period),
      W_(h),
      spacing_(spacing),
      pressure_scale_(term.pressure_scale(material)),
      skin_(0.3 * h) {
  const double slope = half_plane(W_, spacing, 0.5 * spacing).slope;  // pressed in by half a spacing
  S_0_ = half_plane(W_, spacing, spacing).sum;
  const double inverse_rho = 1.0 / material.density;
  highest_frequency_ = slope * std::sqrt(pressure_scale_ * inverse_rho / S_0_);
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (const Vec& X : fill({walls_[w].box}, {}, spacing)) {
      X_.push_back(X);
      wall_of_.push_back(w);
    }
}

ContactWalls::State ContactWalls::start() const {
  State state;
  state.number.resize(X_.size());
  std::iota(state.number.begin(), state.number.end(), 0u);
  return state;
}

void ContactWalls::place(State& state, double time) const {
  std::vector<Pose> poses(walls_.size());
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].motion) poses[w] = walls_[w].motion->pose_at(time);
  resize(state.x, padded(X_.size()));
  for (std::size_t k = 0; k < X_.size(); ++k)
    set(state.x, k, period_.inside(poses[wall_of_[state.number[k]]].place(X_[state.number[k]])));
  state.time_placed = time;
}

void ContactWalls::list(State& state, std::size_t count) const {
  place(state, state.time_listed);
  state.x_listed = state.x;
  StripOrder strips = strips_of(spacing_);
  strips.index(state.x[0], X_.size());
  state.list.build(state.solid_listed, count, state.x, strips, W_.support() + skin_, period_.shifts());
}

void ContactWalls::prepare(State& state, const VecField& x, std::size_t count, double time) const {
  place(state, time);
  if (!state.solid_listed[0].empty()) {
    const double solid = largest_distance(x, state.solid_listed, count);
    const double walls = largest_distance(state.x, state.x_listed, X_.size());
    if (!skin_exhausted(solid, walls, 0.9 * skin_)) return;
  }
  std::vector<std::uint32_t> scratch;
  reorder(state.number, strips_of(spacing_).sort(state.x[0], state.x[1], X_.size()), scratch);
  state.solid_listed = x;
  state.time_listed = time;
  list(state, count);
}

void ContactWalls::complete(State& state, std::size_t count) const {
  const double time = state.time_placed;
  list(state, count);
  place(state, time);
}

Lanes ContactWalls::overlap(const State& state, const VecField& x, std::size_t cluster,
                            VecLanes& gradient) const {
  const double V = spacing_ * spacing_, tiny = 1e-16 * W_.h() * W_.h();
  Lanes S = 0.0;
  gradient = zero_vector();
  over_places(state.list.near(cluster), load(x, cluster * lane_count), pointers(state.x),
              [&](std::uint32_t, const VecLanes& x_iw) TORYU_INLINE_LAMBDA {
                const Lanes r_squared = dot(x_iw, x_iw) + tiny, inverse_r = inverse_sqrt(r_squared),
                            r = r_squared * inverse_r;
                S += V * W_.value(r);
                add_product(gradient, V * W_.gradient_over_r(r, inverse_r), x_iw);
              });
  return S;
}

VecLanes ContactWalls::acceleration(const State& state, const VecField& x, std::size_t cluster,
                                    const Lanes& inverse_rho) const {
  VecLanes gradient;
  const Lanes S = overlap(state, x, cluster, gradient);
  const Lanes p = pressure_scale_ * positive_part(S * (1.0 / S_0_) - 1.0);
  return product(-inverse_rho * p, gradient);
}

Lanes ContactWalls::energy_density(const State& state, const VecField& x, std::size_t cluster) const {
  VecLanes gradient;
  const Lanes beyond = positive_part(overlap(state, x, cluster, gradient) * (1.0 / S_0_) - 1.0);
  return 0.5 * pressure_scale_ * S_0_ * beyond * beyond;
}

}  // namespace toryu::solid
