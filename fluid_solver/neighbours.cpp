#include "fluid_solver/neighbours.hpp"

#include "common/sph/skin.hpp"

namespace toryu::fluid {

namespace {

/// Returns the order: who comes k-th was at `order[k]`.
std::vector<std::uint32_t> sort(Particles& f, const StripOrder& strips) {
  auto order = strips.sort(f.x[0], f.x[1], f.count);
  reorder_fields(f, order);
  std::fill(f.m.begin() + static_cast<std::ptrdiff_t>(f.count), f.m.end(), 0.0);  // idle lanes weigh nothing
  std::vector<std::uint32_t> id(f.count);
  for (std::size_t k = 0; k < f.count; ++k) id[k] = f.id[order[k]];
  f.id.swap(id);
  return order;
}

/// How far a particle may be from where it was when it had gone `moved` [m], after the next `dt` [s]. Of all
/// ranks each by itself: a sum of the largest is another where they are apart.
double farthest(double moved, const Particles& fluid, double dt, const Ranks* ranks) {
  std::array<double, 3> largest{moved, largest_norm(fluid.v, fluid.count),
                                largest_norm(fluid.a, fluid.count)};
  if (ranks) ranks->take_largest(largest);
  return largest[0] + dt * (largest[1] + dt * largest[2]);
}
double farthest_step(const Boundary& boundary, double dt) {
  return dt * (largest_norm(boundary.v, boundary.count) +
               dt * largest_norm(boundary.acceleration, boundary.count));
}

// As a share of the support: it bears a fluid at rest that is struck within a step.
constexpr double smallest_skin = 0.02;

}  // namespace

bool Neighbours::exhausted(const Particles& fluid, const std::vector<Boundary>& boundaries, double dt,
                           const Ranks* ranks) const {
  if (state_.builds == 0) return true;
  const double moved_fluid = farthest(largest_distance(fluid.x, state_.fluid, fluid.count), fluid, dt, ranks);
  double moved = moved_fluid;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].moves())
      moved = std::max(moved, largest_distance(boundaries[b].x, state_.boundaries[b], boundaries[b].count) +
                                  farthest_step(boundaries[b], dt));
  return skin_exhausted(moved_fluid, moved, state_.skin);
}

double Neighbours::best_skin(const Particles& fluid, const std::vector<Boundary>& boundaries, double dt,
                             const Ranks* ranks) const {
  double step = farthest(0, fluid, dt, ranks);
  for (const Boundary& boundary : boundaries)
    if (boundary.moves()) step = std::max(step, farthest_step(boundary, dt));
  const double best = std::sqrt(support_ * 2 * step);
  return std::min(std::max(best, smallest_skin * support_), largest_skin_);
}

void Neighbours::build(Particles& fluid, std::vector<Boundary>& boundaries, double dt, Ranks* ranks) {
  ++state_.builds;
  state_.skin = best_skin(fluid, boundaries, dt, ranks);
  if (ranks) ranks->divide(fluid, depth_of_ghosts(), shifts_);
  const auto order = sort(fluid, strips_);
  if (ranks) {
    ranks->follow(order);
    ranks->number(fluid, strips_);
  }
  state_.fluid = fluid.x;
  state_.boundaries.resize(boundaries.size());
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    std::fill(boundaries[b].p.begin(), boundaries[b].p.end(), 0.0);  // where no fluid is near any more
    if (!boundaries[b].moves()) continue;
    boundaries[b].sort();
    state_.boundaries[b] = boundaries[b].x;
  }
  build_lists(fluid.count, boundaries);
  if (ranks) ranks->note_lists(fluid, of_fluid_, boundaries, near_interface(fluid.count, boundaries));
}

void Neighbours::rebuild(const Particles& fluid, std::vector<Boundary>& boundaries) {
  if (state_.builds > 0) build_lists(fluid.count, boundaries);
}

void Neighbours::begin_with(const Begun& begun, const Particles& fluid,
                            const std::vector<Boundary>& boundaries) {
  state_.skin = begun.skin, state_.builds = begun.builds;
  state_.fluid = fluid.x;
  state_.boundaries.resize(boundaries.size());
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].moves()) state_.boundaries[b] = boundaries[b].x;
}

void Neighbours::divide(Particles& fluid, std::vector<Boundary>& boundaries, Ranks& ranks) {
  if (state_.builds == 0) return;
  for (int a = 0; a < dim; ++a) fluid.x[a].swap(state_.fluid[a]);  // they were divided there
  ranks.divide(fluid, depth_of_ghosts(), shifts_, &state_.fluid);
  for (int a = 0; a < dim; ++a) fluid.x[a].swap(state_.fluid[a]);
  build_lists(fluid.count, boundaries);
  ranks.note_lists(fluid, of_fluid_, boundaries, near_interface(fluid.count, boundaries));
}

void Neighbours::forget(std::vector<Boundary>& boundaries) {
  state_.fluid = {};
  of_fluid_ = {};
  for (Boundary& boundary : boundaries) boundary.list_for_fluid = boundary.list_for_wall = {};
}

std::vector<std::uint32_t> Neighbours::near_interface(std::size_t fluid_count,
                                                      const std::vector<Boundary>& boundaries) const {
  std::vector<std::uint32_t> near;
  if (boundaries.empty() || !boundaries.back().is_interface()) return near;
  const Boundary& boundary = boundaries.back();
  const VecField& x_b = state_.boundaries.back();
  const double reach = support_ + state_.skin;
  for (const auto c : boundary.list_for_fluid.active())
    for (std::size_t i = c * lane_count; i < std::min((c + 1) * lane_count, fluid_count); ++i) {
      const auto is_near = [&](const ShiftedNeighbours& sources) {
        const Vec x = at(state_.fluid, i) + sources.shift;
        return std::any_of(sources.sources.begin(), sources.sources.end(),
                           [&](std::uint32_t j) { return (x - at(x_b, j)).squaredNorm() < reach * reach; });
      };
      const auto all = boundary.list_for_fluid.near(c);
      if (std::any_of(all.begin(), all.end(), is_near)) near.push_back(static_cast<std::uint32_t>(i));
    }
  return near;
}

void Neighbours::collect(const Neighbours& part, const Ranks& ranks, Neighbours* whole) {
  const VecField& x = part.state_.fluid;
  if (!whole) return ranks.collect({&x[0], &x[1]}, {});
  VecField all = std::move(whole->state_.fluid);
  resize(all, padded(ranks.count_of_whole()));
  ranks.collect({&x[0], &x[1]}, {&all[0], &all[1]});
  whole->state_ = {std::move(all), part.state_.boundaries, part.state_.skin, part.state_.builds};
}

void Neighbours::build_lists(std::size_t fluid_count, std::vector<Boundary>& boundaries) {
  const VecField& x = state_.fluid;
  const double reach = support_ + state_.skin;
  strips_.index(x[0], fluid_count);
  const auto build = [&](ClusterList& list, const VecField& targets, std::size_t target_count,
                         const VecField& sources, std::size_t source_count, const StripOrder& strips) {
    if (geometry_ == Geometry::plane)
      list.build(targets, target_count, sources, strips, reach, shifts_);
    else
      list.build_with_images(targets, target_count, sources, strips, reach, shifts_, padded(source_count));
  };
  build(of_fluid_, x, fluid_count, x, fluid_count, strips_);
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    Boundary& boundary = boundaries[b];
    const VecField& x_b = boundary.moves() ? state_.boundaries[b] : boundary.x;
    boundary.strips.index(x_b[0], boundary.count);
    build(boundary.list_for_fluid, x, fluid_count, x_b, boundary.count, boundary.strips);
    build(boundary.list_for_wall, x_b, boundary.count, x, fluid_count, strips_);
  }
}

}  // namespace toryu::fluid
