#include "fluid_solver/consistent_gradients.hpp"

#include "fluid_solver/terms/renormalisation.hpp"

namespace toryu::fluid {

namespace {

/// Sums over the neighbours of one cluster.
struct Sums {
  Moment moment;
  TensorLanes v = zero_tensor();  ///< sum_j V_j (v_j - v_i) (x) gradW_ij, one row a component of the velocity
  VecLanes p = zero_vector();     ///< sum_j V_j (p_j - p_i) gradW_ij
  VecLanes a = zero_vector();     ///< (22)
  VecLanes k_v = zero_vector(), k_x = zero_vector();  ///< sums of k_ij v_ij, k_ij x_ij
};

template <class W>
Sums sums_of(const Particles& f, double mu, const W& kernel, std::size_t first, std::span<const Near> nears) {
  const VecLanes v_i = load(f.v, first);
  const Lanes p_i = load(f.p, first), p_rho2_i = load(f.p_rho2, first);
  const Lanes two_nu = 2.0 * mu * inverse(load(f.rho, first));
  Sums sums;
  for (const Near& near : nears) {
    const VecLanes x_i = shifted(load(f.x, first), near.shift);
    for (const std::uint32_t j : near.sources) {
      const VecLanes x_ij{x_i[0] - f.x[0][j], x_i[1] - f.x[1][j]};
      const Lanes r2 = max(dot(x_ij, x_ij), 1e-300), inverse_r = inverse_sqrt(r2);
      const Lanes G = kernel.gradient_over_r(r2 * inverse_r, inverse_r), V_G = f.V[j] * G;
      const VecLanes V_grad{V_G * x_ij[0], V_G * x_ij[1]};
      sums.moment.add(x_ij, V_grad);
      const Lanes p_ji = f.p[j] - p_i, push = f.m[j] * (f.p_rho2[j] + p_rho2_i) * G;
      const Lanes k = two_nu * V_G;
      for (int a = 0; a < dim; ++a) {
        sums.p[a] += p_ji * V_grad[a];
        sums.a[a] -= push * x_ij[a];
        sums.k_v[a] += k * (v_i[a] - f.v[a][j]);
        sums.k_x[a] += k * x_ij[a];
      }
      for (int b = 0; b < dim; ++b) {
        const Lanes v_ji = f.v[b][j] - v_i[b];
        for (int a = 0; a < dim; ++a) sums.v[b][a] += v_ji * V_grad[a];
      }
    }
  }
  return sums;
}

/// What the consistent rates have beyond the others.
struct Difference {
  Lanes divergence;
  VecLanes a;
};
Difference difference(Sums& sums, const Lanes& rho) {
  sums.moment.invert();
  const VecLanes grad_p = sums.moment.renormalised(sums.p);
  const Lanes inverse_rho = inverse(rho);
  const Lanes share = 2.0 * inverse(max(sums.moment.trace(), 1.0));
  Difference found{-(sums.v[0][0] + sums.v[1][1]), {}};
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
                               const std::vector<Boundary>& boundaries, const Kernel& kernel) {
  kernel.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      if (wall_in_reach(boundaries, c)) continue;
      const std::size_t first = c * lane_count;
      const Lanes rho = load(fluid.rho, first), inside = load(fluid.inside, first);
      Sums sums = sums_of(fluid, mu, W, first, neighbours.near(c));
      const Difference more = difference(sums, rho);
      if (wanted != RatesOf::velocity)
        store(load(fluid.drho, first) - inside * rho * more.divergence, fluid.drho, first);
      if (wanted != RatesOf::density)
        for (int a = 0; a < dim; ++a) store(load(fluid.a[a], first) + inside * more.a[a], fluid.a[a], first);
    }
  });
}

}  // namespace toryu::fluid
