#include "fluid_solver/weakly_compressible/consistent_gradients.hpp"

#include "common/sph/neighbour_loop.hpp"
#include "common/sph/renormalisation.hpp"

namespace toryu::fluid {

namespace {

/// Sums over the neighbours of one cluster.
struct GradientSums {
  Moment moment;
  TensorLanes v = zero_tensor();  ///< sum_j V_j (v_j - v_i) (x) gradW_ij, one row a component of the velocity
  VecLanes p = zero_vector();     ///< sum_j V_j (p_j - p_i) gradW_ij
  VecLanes a = zero_vector();     ///< (22)
  VecLanes k_v = zero_vector(), k_x = zero_vector();  ///< sums of k_ij v_ij, k_ij x_ij
};

template <class W>
GradientSums sums_of(const Particles& f, double mu, const W& kernel, std::size_t first,
                     std::span<const ShiftedNeighbours> nears) {
  const VecLanes v_i = load(f.v, first);
  const Lanes p_i = load(f.p, first), p_rho2_i = load(f.p_rho2, first);
  const Lanes two_nu = 2.0 * mu * inverse(load(f.rho, first));
  GradientSums sums;
  over_neighbours(kernel, nears, load(f.x, first), pointers(f.x),
                  [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const VecLanes V_grad = n.gradient(f.V[j]);
                    sums.moment.add(n.x_ij, V_grad);
                    add_product(sums.p, f.p[j] - p_i, V_grad);
                    const Lanes push = f.m[j] * (f.p_rho2[j] + p_rho2_i) * n.G, k = two_nu * (f.V[j] * n.G);
                    for (int a = 0; a < dim; ++a) {
                      sums.a[a] -= push * n.x_ij[a];
                      sums.k_v[a] += k * (v_i[a] - f.v[a][j]);
                    }
                    add_product(sums.k_x, k, n.x_ij);
                    for (int b = 0; b < dim; ++b) add_product(sums.v[b], f.v[b][j] - v_i[b], V_grad);
                  });
  return sums;
}

/// What the consistent rates have beyond the others.
struct Difference {
  Lanes divergence;
  VecLanes a;
};
// One for all kernels, so that it rounds alike wherever it stands.
[[gnu::noinline]] Difference difference(GradientSums& sums, const Lanes& rho) {
  sums.moment.invert();
  const VecLanes grad_p = sums.moment.renormalised(sums.p);
  const Lanes inverse_rho = inverse(rho);
  const Lanes share = 2.0 * inverse(max(sums.moment.trace(), 1.0));
  Difference found{-trace(sums.v), {}};
  for (int a = 0; a < dim; ++a) {
    const VecLanes grad_v_a = sums.moment.renormalised(sums.v[a]);
    found.divergence += grad_v_a[a];
    const Lanes viscous = share * (sums.k_v[a] - dot(grad_v_a, sums.k_x));
    found.a[a] = (viscous - sums.k_v[a]) - (grad_p[a] * inverse_rho + sums.a[a]);
  }
  return found;
}

}  // namespace

void make_gradients_consistent(RatesOf wanted, double mu, Particles& fluid, const ClusterList& neighbours,
                               const Kernel& kernel, const std::vector<std::uint32_t>* some) {
  const std::size_t count = some ? some->size() : fluid.clusters();
  kernel.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = some ? (*some)[k] : k, first = c * lane_count;
      const Lanes rho = load(fluid.rho, first), deep = load(fluid.off_surface_and_walls, first);
      if (sum_of(deep) == 0) continue;
      GradientSums sums = sums_of(fluid, mu, W, first, neighbours.near(c));
      const Difference more = difference(sums, rho);
      if (wanted != RatesOf::velocity)
        store(load(fluid.drho, first) - deep * rho * more.divergence, fluid.drho, first);
      if (wanted != RatesOf::density)
        for (int a = 0; a < dim; ++a) store(load(fluid.a[a], first) + deep * more.a[a], fluid.a[a], first);
    }
  });
}

}  // namespace toryu::fluid
