#include "fluid_solver/wall_turning.hpp"

#include <algorithm>

namespace toryu::fluid {

double wetted_surface_moment(const Boundary& boundary, const Particles& fluid, const Kernel& kernel,
                             std::size_t b, const Ranks* ranks) {
  Field moment(padded(boundary.count));
  kernel.visit([&](const auto& W) {
    for (const auto cluster : boundary.list_for_wall.active()) {
      const std::size_t first = cluster * lane_count;
      VecLanes r_w = load(boundary.x, first);
      for (int a = 0; a < dim; ++a) r_w[a] -= boundary.pivot[a];
      Lanes of_cluster = 0.0;
      over_neighbours(W, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                      [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                        of_cluster += fluid.V[i] * n.G * (dot(r_w, n.x_ij) - 0.5 * n.r2);
                      });
      store(of_cluster, moment, first);
    }
  });
  if (ranks) ranks->collect_at(b, {&moment});
  double sum = 0;
  for (std::size_t k = 0; k < boundary.count; ++k) sum += boundary.V[k] * moment[k];
  return 2 * sum;
}

}  // namespace toryu::fluid
