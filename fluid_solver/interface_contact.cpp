#include "fluid_solver/interface_contact.hpp"

#include <algorithm>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

namespace {

/// A sum of m W below this share of that of a whole row of fluid means that none is in reach.
constexpr double smallest_share = 1e-9;

/// Of each particle of the interface the impulse that it takes from the fluid over sum_j m_j W_ij; zero
/// where no fluid is in reach, and then its impulse is in `not_given`.
template <class W>
VecField shares(const W& kernel, const std::vector<double>& impulse, const std::vector<Boundary>& boundaries,
                const Particles& fluid, const Ranks* ranks, std::vector<double>& not_given) {
  const Boundary& interface = boundaries.back();
  VecField share;
  resize(share, interface.V.size());
  Field reached(interface.V.size());
  for (const auto c : interface.list_for_wall.active()) {
    Lanes sum = 0.0;
    over_neighbours(kernel, interface.list_for_wall.near(c), load(interface.x, c * lane_count),
                    pointers(fluid.x), [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                      sum += fluid.m[j] * kernel.value(n.r);
                    });
    store(sum, reached, c * lane_count);
  }
  if (ranks) ranks->collect_at(boundaries.size() - 1, {&reached});
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

/// What changes of velocity do to the fluid, cluster by cluster.
void add(const Lanes& m, const VecLanes& v, const VecLanes& dv, GivenImpulse& given) {
  for (int a = 0; a < dim; ++a) {
    given.received[a] += sum_of(m * dv[a]);
    given.work += sum_of(m * dv[a] * (v[a] + 0.5 * dv[a]));
  }
}

}  // namespace

std::vector<double> impedance(const std::vector<Boundary>& boundaries, const Particles& fluid,
                              const Kernel& kernel, double rest_density, double sound_speed,
                              const Ranks* ranks) {
  const Boundary& interface = boundaries.back();
  VecField z;
  resize(z, interface.V.size());
  kernel.visit([&](const auto& W) {
    for (const auto c : interface.list_for_wall.active()) {
      VecLanes sum = zero_vector();
      over_neighbours(W, interface.list_for_wall.near(c), load(interface.x, c * lane_count),
                      pointers(fluid.x), [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                        add_product(sum, fluid.V[j] * n.G, n.x_ij);
                      });
      const Lanes factor = 2.0 * rest_density * sound_speed * load(interface.V, c * lane_count);
      store(product(factor, sum), z, c * lane_count);
    }
  });
  if (ranks) ranks->collect_at(boundaries.size() - 1, {&z[0], &z[1]});
  std::vector<double> by_id(dim * interface.count);
  for (std::size_t k = 0; k < interface.count; ++k)
    for (std::size_t a = 0; a < dim; ++a) by_id[std::size_t{dim} * interface.id[k] + a] = z[a][k];
  return by_id;
}

GivenImpulse give_impulse(const std::vector<double>& impulse, const std::vector<Boundary>& boundaries,
                          Particles& fluid, const Kernel& kernel, const Ranks* ranks) {
  const Boundary& interface = boundaries.back();
  GivenImpulse given;
  if (interface.list_for_wall.clusters() == 0) {  // before the first step nobody knows who is near
    given.not_given = impulse;
    return given;
  }
  given.not_given.assign(impulse.size(), 0.0);
  VecField dv;
  resize(dv, fluid.rho.size());
  kernel.visit([&](const auto& W) {
    const VecField share = shares(W, impulse, boundaries, fluid, ranks, given.not_given);
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      if (!interface.acts_on(c)) continue;
      VecLanes sum = zero_vector();
      over_neighbours(W, interface.list_for_fluid.near(c), load(fluid.x, c * lane_count),
                      pointers(interface.x), [&](std::uint32_t k, const Neighbour& n) TORYU_INLINE_LAMBDA {
                        const Lanes W_jk = W.value(n.r);
                        for (int a = 0; a < dim; ++a) sum[a] += share[a][k] * W_jk;
                      });
      store(sum, dv, c * lane_count);
      if (!ranks) add(load(fluid.m, c * lane_count), load(fluid.v, c * lane_count), sum, given);
    }
  });
  if (ranks) {
    ranks->share({&dv[0], &dv[1]});
    const auto of_all =
        ranks->collect_beside(boundaries.size() - 1, {&fluid.v[0], &fluid.v[1], &dv[0], &dv[1]});
    for (std::size_t k = 0; k < of_all[0].size(); k += lane_count)
      add(load(of_all[4], k), {load(of_all[0], k), load(of_all[1], k)},
          {load(of_all[2], k), load(of_all[3], k)}, given);
  }
  for (std::size_t c = 0; c < fluid.clusters(); ++c)
    if (ranks || interface.acts_on(c))  // ghosts far from it have the change from their owners
      for (int a = 0; a < dim; ++a) {
        const std::size_t first = c * lane_count;
        store(load(fluid.v[a], first) + load(dv[a], first), fluid.v[a], first);
      }
  return given;
}

}  // namespace toryu::fluid
