#include "fluid_solver/weakly_compressible/shifting.hpp"

#include <algorithm>

#include "common/sph/neighbour_loop.hpp"
#include "common/sph/renormalisation.hpp"
#include "fluid_solver/weakly_compressible/polymer.hpp"

namespace toryu::fluid {

namespace {

constexpr double R = 0.2;

/// Sums over the neighbours of one cluster.
struct ShiftingSums {
  VecLanes crowding = zero_vector();  ///< sum_j V_j [1 + R (W_ij/W(d_0))^4] gradW_ij
  Moment moment;                      ///< of fluid neighbours
  TensorLanes v = zero_tensor();      ///< one row a component of the velocity
  VecLanes rho = zero_vector();
};

/// `inverse_W_d0` is 1/W(d_0).
template <bool fluid_sources, class W>
void add(ShiftingSums& sums, const VecLanes& x_i, const VecLanes& v_i, const Lanes& rho_i,
         const Sources& source, std::span<const ShiftedNeighbours> nears, const W& kernel,
         double inverse_W_d0) {
  over_neighbours(kernel, nears, x_i, source.x, [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
    const VecLanes V_grad = n.gradient(source.V[j]);
    const Lanes share = kernel.value(n.r) * inverse_W_d0, share_2 = share * share;
    add_product(sums.crowding, 1.0 + R * (share_2 * share_2), V_grad);
    if constexpr (fluid_sources) {
      sums.moment.add(n.x_ij, V_grad);
      add_product(sums.rho, source.rho[j] - rho_i, V_grad);
      for (int b = 0; b < dim; ++b) add_product(sums.v[b], source.v[b][j] - v_i[b], V_grad);
    }
  });
}

}  // namespace

void Shifting::shift(Particles& fluid, const ClusterList& neighbours, const std::vector<Boundary>& boundaries,
                     double largest_speed, double dt) {
  const double factor = -strength_ * kernel_.h() * largest_speed * dt, longest = 0.5 * largest_speed * dt;
  moved_.resize(fluid.clusters());
  resize(dx_, padded(fluid.count));
  kernel_.visit([&](const auto& W) {
    const double inverse_W_d0 = 1.0 / W.value(spacing_);
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      const std::size_t first = c * lane_count;
      const VecLanes x_i = load(fluid.x, first), v_i = load(fluid.v, first);
      const Lanes rho_i = load(fluid.rho, first);
      ShiftingSums sums;
      add<true>(sums, x_i, v_i, rho_i, sources(fluid), neighbours.near(c), W, inverse_W_d0);
      for (const auto& wall : boundaries)
        add<false>(sums, x_i, v_i, rho_i, sources(wall), wall.list_for_fluid.near(c), W, inverse_W_d0);
      static_assert(dim == 2, "written out: loops over the axes are contracted otherwise");
      VecLanes dx{factor * sums.crowding[0], factor * sums.crowding[1]};
      const Lanes length = square_root(dot(dx, dx));
      const Lanes share = load(fluid.off_surface, first) * min(1.0, longest * inverse(max(length, 1e-300)));
      for (auto& component : dx) component *= share;
      sums.moment.invert();
      moved_[c] = {{v_i[0] + dot(dx, sums.moment.renormalised(sums.v[0])),
                    v_i[1] + dot(dx, sums.moment.renormalised(sums.v[1]))},
                   rho_i + dot(dx, sums.moment.renormalised(sums.rho))};
      store(dx, dx_, first);
    }
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c)
      if (std::any_of(boundaries.begin(), boundaries.end(),
                      [&](const auto& wall) { return wall.acts_on(c); }))
        moved_[c].rho = density_beside_walls(fluid, neighbours, boundaries, W, c);
    if (!fluid.log_conformation[0].xx.empty()) carry_log_conformation(fluid, neighbours, W);
  });
  for (std::size_t c = 0; c < fluid.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    for (int a = 0; a < dim; ++a) store(load(fluid.x[a], first) + load(dx_[a], first), fluid.x[a], first);
    store(moved_[c].v, fluid.v, first);
    store(moved_[c].rho, fluid.rho, first);
  }
}

template <class W>
void Shifting::carry_log_conformation(Particles& fluid, const ClusterList& neighbours, const W& kernel) {
  std::vector<Field*> fields;
  for_each_log_conformation(fluid, [&](Field& psi, const Field&, std::size_t) { fields.push_back(&psi); });
  carried_.resize(fields.size());
  for (Field& carried : carried_) carried.resize(padded(fluid.count));
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t c = 0; c < fluid.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    Moment moment;
    std::array<VecLanes, 3 * most_polymer_modes> sums;
    sums.fill(zero_vector());
    over_neighbours(kernel, neighbours.near(c), load(fluid.x, first), pointers(fluid.x),
                    [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                      const VecLanes V_grad = n.gradient(fluid.V[j]);
                      moment.add(n.x_ij, V_grad);
                      for (std::size_t k = 0; k < fields.size(); ++k)
                        add_product(sums[k], (*fields[k])[j] - load(*fields[k], first), V_grad);
                    });
    moment.invert();
    const VecLanes dx = load(dx_, first);
    for (std::size_t k = 0; k < fields.size(); ++k)
      store(load(*fields[k], first) + dot(dx, moment.renormalised(sums[k])), carried_[k], first);
  }
  for (std::size_t k = 0; k < fields.size(); ++k) fields[k]->swap(carried_[k]);
}

template <class W>
Lanes Shifting::density_beside_walls(const Particles& fluid, const ClusterList& neighbours,
                                     const std::vector<Boundary>& boundaries, const W& kernel,
                                     std::size_t cluster) const {
  const std::size_t first = cluster * lane_count;
  const VecLanes x_i = load(fluid.x, first), dx_i = load(dx_, first);
  const Lanes rho_i = load(fluid.rho, first);
  const Positions dx = pointers(dx_);
  Lanes compression = 0.0, beside = 0.0;
  over_neighbours(kernel, neighbours.near(cluster), x_i, pointers(fluid.x),
                  [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    compression += dot(difference(dx_i, dx, j), n.gradient(fluid.V[j]));
                  });
  for (const auto& wall : boundaries)
    over_neighbours(kernel, wall.list_for_fluid.near(cluster), x_i, pointers(wall.x),
                    [&](std::uint32_t w, const Neighbour& n) TORYU_INLINE_LAMBDA {
                      compression += dot(dx_i, n.gradient(wall.V[w]));
                      beside = select(n.r < kernel.support(), 1.0, beside);
                    });
  return select(beside > 0.0, rho_i + rho_i * compression, moved_[cluster].rho);
}

}  // namespace toryu::fluid
