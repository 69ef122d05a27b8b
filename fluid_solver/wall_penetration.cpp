#include "fluid_solver/wall_penetration.hpp"

#include <cmath>
#include <numeric>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

namespace {

constexpr double filled = 0.75;

/// Counts those that are `inside`, in order.
Penetration count(const std::string& boundary, const Field& inside, const Field& x, const Field& y) {
  Penetration found{.boundary = boundary};
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i] > 0 && found.count++ == 0) found.place = {x[i], y[i]};
  return found;
}

/// Into boundary `b`.
Penetration into(const Boundary& boundary, const Particles& fluid, std::size_t b, const Ranks* ranks) {
  const double V = std::accumulate(boundary.V.begin(), boundary.V.begin() + boundary.count, 0.0);
  const CubicSpline W(std::sqrt(V / static_cast<double>(boundary.count)));
  Field inside(padded(fluid.count));
  for (const auto c : boundary.list_for_fluid.active()) {
    Lanes share = 0.0;
    over_neighbours(W, boundary.list_for_fluid.near(c), load(fluid.x, c * lane_count), pointers(boundary.x),
                    [&](std::uint32_t w, const Neighbour& n)
                        TORYU_INLINE_LAMBDA { share += boundary.V[w] * W.value(n.r); });
    store(select(share > filled, 1.0, 0.0), inside, c * lane_count);
  }
  if (ranks) {
    const auto near = ranks->collect_beside(b, {&inside, &fluid.x[0], &fluid.x[1]});
    return count(boundary.name, near[0], near[1], near[2]);
  }
  std::fill(inside.begin() + static_cast<std::ptrdiff_t>(fluid.count), inside.end(), 0.0);  // idle lanes
  return count(boundary.name, inside, fluid.x[0], fluid.x[1]);
}

}  // namespace

Penetration penetration(const Particles& fluid, const std::vector<Boundary>& boundaries, const Ranks* ranks) {
  Penetration all;
  std::size_t most = 0;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const Penetration found = into(boundaries[b], fluid, b, ranks);
    const std::size_t count = all.count + found.count;
    if (found.count > most) {
      all = found;
      most = found.count;
    }
    all.count = count;
  }
  return all;
}

}  // namespace toryu::fluid
