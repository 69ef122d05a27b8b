#include "fluid_solver/neighbours.hpp"

#include <cmath>

namespace toryu::fluid {

namespace {

double largest_distance(const VecField& x, const VecField& y, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, (at(x, i) - at(y, i)).squaredNorm());
  return std::sqrt(largest);
}

void sort(Particles& f, const StripOrder& strips) {
  const auto order = strips.sort(f.x[0], f.x[1], f.count);
  Field scratch;
  for (int a = 0; a < dim; ++a) {
    reorder(f.x[a], order, scratch);
    reorder(f.v[a], order, scratch);
  }
  reorder(f.rho, order, scratch);
  // kept from the last step: for the free surface, and for the symplectic step
  reorder(f.V, order, scratch);
  reorder(f.drho, order, scratch);
  reorder(f.m, order, scratch);
  std::fill(f.m.begin() + static_cast<std::ptrdiff_t>(f.count), f.m.end(), 0.0);  // idle lanes weigh nothing
  std::vector<std::uint32_t> id(f.count);
  for (std::size_t k = 0; k < f.count; ++k) id[k] = f.id[order[k]];
  f.id.swap(id);
}

}  // namespace

double largest_norm(const VecField& v, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, at(v, i).squaredNorm());
  return std::sqrt(largest);
}

bool Neighbours::exhausted(const Particles& fluid, const std::vector<Boundary>& boundaries, double dt) const {
  if (builds_ == 0) return true;
  const double moved_fluid =
      largest_distance(fluid.x, built_fluid_, fluid.count) + dt * largest_norm(fluid.v, fluid.count);
  double moved = moved_fluid;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].moves)
      moved = std::max(moved, largest_distance(boundaries[b].x, built_boundaries_[b], boundaries[b].count) +
                                  dt * largest_norm(boundaries[b].v, boundaries[b].count));
  return moved_fluid + moved > skin_;
}

void Neighbours::build(Particles& fluid, std::vector<Boundary>& boundaries) {
  ++builds_;
  sort(fluid, strips_);
  strips_.index(fluid.x[0], fluid.count);
  const double reach = support_ + skin_;
  of_fluid_.build(fluid.x, fluid.count, fluid.x, strips_, reach, shifts_);
  built_fluid_ = fluid.x;
  built_boundaries_.resize(boundaries.size());
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    auto& boundary = boundaries[b];
    std::fill(boundary.p.begin(), boundary.p.end(), 0.0);  // where no fluid is near any more
    if (boundary.moves) {
      boundary.sort();
      built_boundaries_[b] = boundary.x;
    }
    boundary.list_for_fluid.build(fluid.x, fluid.count, boundary.x, boundary.strips, reach, shifts_);
    boundary.list_for_wall.build(boundary.x, boundary.count, fluid.x, strips_, reach, shifts_);
  }
}

}  // namespace toryu::fluid
