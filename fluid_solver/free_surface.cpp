#include "fluid_solver/free_surface.hpp"

#include "fluid_solver/terms/neighbour_sum.hpp"
#include "fluid_solver/terms/renormalisation.hpp"

namespace toryu::fluid {

namespace {

template <class W>
void add_moment(Moment& moment, const VecLanes& x_i, const Sources& sources, std::span<const Near> nears,
                const W& kernel) {
  over_neighbours(kernel, nears, x_i, sources, [&](std::uint32_t, const Neighbour& n) TORYU_INLINE_LAMBDA {
    moment.add(n.x_ij, n.V_grad);
  });
}

/// 1 where particle i of the cluster has none of those of `at_surface` within `support`.
Lanes none_near(const Particles& fluid, std::span<const Near> nears, const VecLanes& x_i,
                const Field& at_surface, double support) {
  Lanes inside = 1.0;
  for (const Near& near : nears) {
    const VecLanes x = shifted(x_i, near.shift);
    for (const std::uint32_t j : near.sources) {
      if (at_surface[j] == 0) continue;
      const VecLanes x_ij{x[0] - fluid.x[0][j], x[1] - fluid.x[1][j]};
      inside = select(dot(x_ij, x_ij) < support * support, 0.0, inside);
    }
  }
  return inside;
}

}  // namespace

void FreeSurface::find_inside(Particles& fluid, const ClusterList& neighbours,
                              const std::vector<Boundary>& boundaries, const Kernel& kernel) {
  at_surface_.resize(padded(fluid.count));
  fluid.inside.resize(padded(fluid.count));
  kernel.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      const VecLanes x_i = load(fluid.x, c * lane_count);
      Moment moment;
      add_moment(moment, x_i, sources(fluid), neighbours.near(c), W);
      for (const auto& wall : boundaries) add_moment(moment, x_i, sources(wall), wall.near_fluid.near(c), W);
      store(select(moment.smaller_eigenvalue() < surface_moment, 1.0, 0.0), at_surface_, c * lane_count);
    }
  });
  const bool no_surface =
      std::all_of(at_surface_.begin(), at_surface_.begin() + static_cast<std::ptrdiff_t>(fluid.count),
                  [](double is) { return is == 0; });
  if (no_surface) {
    std::fill(fluid.inside.begin(), fluid.inside.end(), 1.0);
    return;
  }
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t c = 0; c < fluid.clusters(); ++c)
    store(none_near(fluid, neighbours.near(c), load(fluid.x, c * lane_count), at_surface_, kernel.support()),
          fluid.inside, c * lane_count);
}

}  // namespace toryu::fluid
