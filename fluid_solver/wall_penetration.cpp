#include "fluid_solver/wall_penetration.hpp"

#include <cmath>
#include <numeric>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

namespace {

constexpr double filled = 0.75;

Penetration into(const Boundary& boundary, const Particles& fluid) {
  const double V = std::accumulate(boundary.V.begin(), boundary.V.begin() + boundary.count, 0.0);
  const CubicSpline W(std::sqrt(V / static_cast<double>(boundary.count)));
  Penetration found{.boundary = boundary.name};
  for (const auto c : boundary.list_for_fluid.active()) {
    Lanes share = 0.0;
    over_neighbours(W, boundary.list_for_fluid.near(c), load(fluid.x, c * lane_count), pointers(boundary.x),
                    [&](std::uint32_t w, const Neighbour& n)
                        TORYU_INLINE_LAMBDA { share += boundary.V[w] * W.value(n.r); });
    for (std::size_t i = c * lane_count; i < std::min((c + 1) * lane_count, fluid.count); ++i)
      if (share[i - c * lane_count] > filled && found.count++ == 0) found.place = at(fluid.x, i);
  }
  return found;
}

}  // namespace

Penetration penetration(const Particles& fluid, const std::vector<Boundary>& boundaries) {
  Penetration all;
  std::size_t most = 0;
  for (const Boundary& boundary : boundaries) {
    const Penetration found = into(boundary, fluid);
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
