#include "fluid_solver/held_volume.hpp"

#include <algorithm>
#include <numeric>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

double volume(const Particles& fluid, const Ranks* ranks) {
  return exact_sums<1>(fluid, ranks, [&](std::size_t i) { return std::array{fluid.m[i] / fluid.rho[i]}; })[0];
}

void hold_volume(Particles& fluid, double held, const Ranks* ranks) {
  const double share = volume(fluid, ranks) / held;
  for (std::size_t i = 0; i < fluid.count; ++i) fluid.rho[i] *= share;
}

double packing(const Particles& fluid, const ClusterList& of_fluid, const std::vector<Boundary>& boundaries,
               const Kernel& kernel, double rho_0, const Ranks* ranks) {
  Field of_particle(padded(fluid.count));
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
      store(filled, of_particle, c * lane_count);
    }
  });
  std::fill(of_particle.begin() + static_cast<std::ptrdiff_t>(fluid.count), of_particle.end(), 0.0);
  std::size_t count = fluid.count;
  if (ranks) of_particle = ranks->of_whole(of_particle), count = ranks->count_of_whole();
  return std::accumulate(of_particle.begin(), of_particle.end(), 0.0) / static_cast<double>(count);
}

}  // namespace toryu::fluid
