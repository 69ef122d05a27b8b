#include "fluid_solver/wall_turning.hpp"

#include <algorithm>

namespace toryu::fluid {

double wetted_surface_moment(const Boundary& boundary, const Particles& fluid, const Kernel& kernel) {
  double sum = 0;
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
      for (std::size_t k = first; k < std::min(first + lane_count, boundary.count); ++k)
        sum += boundary.V[k] * of_cluster[k - first];
    }
  });
  return 2 * sum;
}

}  // namespace toryu::fluid
