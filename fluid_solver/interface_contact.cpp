#include "fluid_solver/interface_contact.hpp"

#include <algorithm>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

namespace {

/// A sum of m W below this share of that of a whole row of fluid means that none is in reach.
constexpr double smallest_share = 1e-9;

/// Adds `value` of each of the cluster's particles to those of `by_id`.
void scatter(const Boundary& interface, std::size_t cluster, const VecLanes& value,
             std::vector<double>& by_id) {
  for (std::size_t k = cluster * lane_count; k < std::min((cluster + 1) * lane_count, interface.count); ++k)
    for (std::size_t a = 0; a < dim; ++a)
      by_id[std::size_t{dim} * interface.id[k] + a] = value[a][k - cluster * lane_count];
}

/// Of each particle of the interface the impulse that it takes from the fluid over sum_j m_j W_ij; zero
/// where no fluid is in reach, and then its impulse is in `not_given`.
template <class W>
VecField shares(const W& kernel, const std::vector<double>& impulse, const Boundary& interface,
                const Particles& fluid, std::vector<double>& not_given) {
  VecField share;
  resize(share, interface.V.size());
  std::vector<double> reached(interface.V.size());
  for (const auto c : interface.list_for_wall.active()) {
    Lanes sum = 0.0;
    over_neighbours(kernel, interface.list_for_wall.near(c), load(interface.x, c * lane_count),
                    pointers(fluid.x), [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                      sum += fluid.m[j] * kernel.value(n.r);
                    });
    for (std::size_t lane = 0; lane < lane_count; ++lane) reached[c * lane_count + lane] = sum[lane];
  }
  for (std::size_t k = 0; k < interface.count; ++k) {
    const Vec J = vector_of(impulse, interface.id[k]);
    if (reached[k] > smallest_share * interface.m[k] * kernel.value(0.0))
      set(share, k, -J / reached[k]);
    else
      for (std::size_t a = 0; a < dim; ++a)
        not_given[std::size_t{dim} * interface.id[k] + a] = J[static_cast<int>(a)];
  }
  return share;
}

}  // namespace

std::vector<double> impedance(const Boundary& interface, const Particles& fluid, const Kernel& kernel,
                              double rest_density, double sound_speed) {
  std::vector<double> by_id(dim * interface.count);
  kernel.visit([&](const auto& W) {
    for (const auto c : interface.list_for_wall.active()) {
      VecLanes sum = zero_vector();
      over_neighbours(W, interface.list_for_wall.near(c), load(interface.x, c * lane_count),
                      pointers(fluid.x), [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                        add_product(sum, fluid.V[j] * n.G, n.x_ij);
                      });
      const Lanes factor = 2.0 * rest_density * sound_speed * load(interface.V, c * lane_count);
      scatter(interface, c, product(factor, sum), by_id);
    }
  });
  return by_id;
}

GivenImpulse give_impulse(const std::vector<double>& impulse, Boundary& interface, Particles& fluid,
                          const Kernel& kernel) {
  GivenImpulse given;
  if (interface.list_for_fluid.clusters() == 0) {  // before the first step nobody knows who is near
    given.not_given = impulse;
    return given;
  }
  given.not_given.assign(impulse.size(), 0.0);
  kernel.visit([&](const auto& W) {
    const VecField share = shares(W, impulse, interface, fluid, given.not_given);
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      if (!interface.acts_on(c)) continue;
      const std::size_t first = c * lane_count;
      VecLanes dv = zero_vector();
      over_neighbours(W, interface.list_for_fluid.near(c), load(fluid.x, first), pointers(interface.x),
                      [&](std::uint32_t k, const Neighbour& n) TORYU_INLINE_LAMBDA {
                        const Lanes W_jk = W.value(n.r);
                        for (int a = 0; a < dim; ++a) dv[a] += share[a][k] * W_jk;
                      });
      const Lanes m = load(fluid.m, first);
      for (int a = 0; a < dim; ++a) {
        const Lanes v = load(fluid.v[a], first);
        given.received[a] += sum_of(m * dv[a]);
        given.work += sum_of(m * dv[a] * (v + 0.5 * dv[a]));
        store(v + dv[a], fluid.v[a], first);
      }
    }
  });
  return given;
}

}  // namespace toryu::fluid
