#include "fluid_solver/held_volume.hpp"

#include <algorithm>
#include <limits>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

double volume(const Particles& fluid) {
  double sum = 0;
  for (std::size_t i = 0; i < fluid.count; ++i) sum += fluid.m[i] / fluid.rho[i];
  return sum;
}

void hold_volume(Particles& fluid, double held) {
  const double share = volume(fluid) / held;
  for (std::size_t i = 0; i < fluid.count; ++i) fluid.rho[i] *= share;
}

double packing(const Particles& fluid, const ClusterList& of_fluid, const std::vector<Boundary>& boundaries,
               const Kernel& kernel, double rho_0) {
  if (of_fluid.clusters() == 0) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  kernel.visit([&](const auto& W) {
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      const VecLanes x_i = load(fluid.x, c * lane_count);
      Lanes filled = 0.0;
      over_neighbours(W, of_fluid.near(c), x_i, pointers(fluid.x),
                      [&](std::uint32_t j, const Neighbour& n)
                          TORYU_INLINE_LAMBDA { filled += fluid.m[j] / rho_0 * W.value(n.r); });
      for (const Boundary& boundary : boundaries)
        over_neighbours(W, boundary.list_for_fluid.near(c), x_i, pointers(boundary.x),
                        [&](std::uint32_t w, const Neighbour& n)
                            TORYU_INLINE_LAMBDA { filled += boundary.V[w] * W.value(n.r); });
      for (std::size_t i = c * lane_count; i < std::min((c + 1) * lane_count, fluid.count); ++i)
        sum += filled[i - c * lane_count];
    }
  });
  return sum / static_cast<double>(fluid.count);
}

}  // namespace toryu::fluid
