#include "fluid_solver/free_surface.hpp"

#include "common/sph/neighbour_loop.hpp"
#include "common/sph/renormalisation.hpp"
#include "fluid_solver/axis_images.hpp"

namespace toryu::fluid {

namespace {

template <class W>
void add_moment(Moment& moment, const VecLanes& x_i, const Sources& sources,
                std::span<const ShiftedNeighbours> nears, const W& kernel) {
  over_neighbours(kernel, nears, x_i, sources.x,
                  [&](std::uint32_t j, const Neighbour& n)
                      TORYU_INLINE_LAMBDA { moment.add(n.x_ij, n.gradient(sources.V[j])); });
}

/// 1 where particle i of the cluster has none of the `sources` that count within `support`.
template <class Counts>
Lanes none_near(const VecLanes& x_i, const Sources& sources, std::span<const ShiftedNeighbours> nears,
                double support, Counts&& counts) {
  Lanes none = 1.0;
  over_places(nears, x_i, sources.x, [&](std::uint32_t j, const VecLanes& x_ij) TORYU_INLINE_LAMBDA {
    if (counts(j)) none = select(dot(x_ij, x_ij) < support * support, 0.0, none);
  });
  return none;
}

/// One cluster at least: a field without values counts as absent.
std::size_t room_of(const Particles& fluid) {
  return padded(std::max<std::size_t>(fluid.count, 1));
}

}  // namespace

void FreeSurface::find_off_surface(Particles& fluid, const ClusterList& neighbours,
                                   const std::vector<Boundary>& boundaries, const Kernel& kernel) {
  at_surface_.resize(fluid.rho.size());  // images, where there are some, too
  fluid.off_surface.resize(room_of(fluid));
  kernel.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      const VecLanes x_i = load(fluid.x, c * lane_count);
      Moment moment;
      add_moment(moment, x_i, sources(fluid), neighbours.near(c), W);
      for (const auto& wall : boundaries)
        add_moment(moment, x_i, sources(wall), wall.list_for_fluid.near(c), W);
      store(select(moment.smaller_eigenvalue() < surface_moment, 1.0, 0.0), at_surface_, c * lane_count);
    }
  });
  if (fluid.rho.size() > padded(fluid.count)) mirror(at_surface_);
  const bool no_surface =
      std::all_of(at_surface_.begin(), at_surface_.begin() + static_cast<std::ptrdiff_t>(fluid.count),
                  [](double is) { return is == 0; });
  if (no_surface) {
    std::fill(fluid.off_surface.begin(), fluid.off_surface.end(), 1.0);
    return;
  }
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t c = 0; c < fluid.clusters(); ++c)
    store(none_near(load(fluid.x, c * lane_count), sources(fluid), neighbours.near(c), kernel.support(),
                    [&](std::uint32_t j) { return at_surface_[j] != 0; }),
          fluid.off_surface, c * lane_count);
}

bool is_closed(const Particles& fluid) {
  for (std::size_t i = 0; i < fluid.count; ++i)
    if (!(fluid.off_surface[i] > 0) && fluid.is_inside(i)) return false;
  return true;
}

void find_off_surface_and_walls(Particles& fluid, const std::vector<Boundary>& boundaries,
                                const Kernel& kernel) {
  fluid.off_surface_and_walls.resize(room_of(fluid));
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t c = 0; c < fluid.clusters(); ++c) {
    Lanes deep = load(fluid.off_surface, c * lane_count);
    for (const auto& wall : boundaries)
      deep *= none_near(load(fluid.x, c * lane_count), sources(wall), wall.list_for_fluid.near(c),
                        kernel.support(), [](std::uint32_t) { return true; });
    store(deep, fluid.off_surface_and_walls, c * lane_count);
  }
}

}  // namespace toryu::fluid
