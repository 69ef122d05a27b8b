/// The definitions of pair_sweeps.hpp, for the file of each kernel.
#pragma once

#include <utility>

#include "fluid_solver/terms/axisymmetry.hpp"
#include "fluid_solver/terms/continuity.hpp"
#include "fluid_solver/terms/pressure.hpp"
#include "fluid_solver/terms/tensile_control.hpp"
#include "fluid_solver/weakly_compressible/pair_loop.hpp"
#include "fluid_solver/weakly_compressible/pair_sweeps.hpp"

namespace toryu::fluid {

namespace {

// Each term joins in where it has something to say.
TORYU_INLINE void add_density(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                              const Pair& p, Rates& r) {
  if constexpr (requires { term.density(i, s, j, p, r); }) term.density(i, s, j, p, r);
}
TORYU_INLINE void add_diffusion(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                                const Pair& p, Rates& r) {
  if constexpr (requires { term.diffusion(i, s, j, p, r); }) term.diffusion(i, s, j, p, r);
}
TORYU_INLINE void add_momentum(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                               const Pair& p, Rates& r) {
  if constexpr (requires { term.momentum(i, s, j, p, r); }) term.momentum(i, s, j, p, r);
}
TORYU_INLINE void add_viscous(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                              const Pair& p, Rates& r) {
  if constexpr (requires { term.viscous(i, s, j, p, r); }) term.viscous(i, s, j, p, r);
}

/// A term that is another one between the fluid and a wall has `density_at_wall` or `at_wall`.
TORYU_INLINE void add_density_at_wall(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                                      const Pair& p, Rates& r) {
  if constexpr (requires { term.density_at_wall(i, s, j, p, r); })
    term.density_at_wall(i, s, j, p, r);
  else
    add_density(term, i, s, j, p, r);
}
TORYU_INLINE void add_at_wall(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                              const Pair& p, Rates& r) {
  if constexpr (requires { term.at_wall(i, s, j, p, r); })
    term.at_wall(i, s, j, p, r);
  else
    add_momentum(term, i, s, j, p, r);
}

template <RatesOf wanted>
inline constexpr bool of_velocity = wanted != RatesOf::density;
template <RatesOf wanted>
inline constexpr bool of_density = wanted != RatesOf::velocity;

/// The rates of one cluster of `fluid` by `terms`.
template <RatesOf wanted, class W, class... Terms>
void rates_of_cluster(const PairSweeps& sweeps, const W& kernel, Particles& fluid,
                      const ClusterList& neighbours, std::vector<Boundary>& boundaries, std::size_t cluster,
                      const Terms... term) {
  const std::size_t first = cluster * lane_count;
  const Sources own = sources(fluid);
  Targets i = load_targets(fluid, first);
  const Lanes p_rho2_i = i.p_rho2;
  if (sweeps.tensile_control) i.p_rho2 = without_tension(p_rho2_i, load(fluid.off_surface_and_walls, first));
  Rates rates;
  over_pairs<PairsOf::fluid>(kernel, neighbours.near(cluster), i, own,
                             [&](std::size_t j, const Pair& pair) TORYU_INLINE_LAMBDA {
                               if constexpr (of_density<wanted>) {
                                 (add_density(term, i, own, j, pair, rates), ...);
                                 (add_diffusion(term, i, own, j, pair, rates), ...);
                               }
                               if constexpr (of_velocity<wanted>) {
                                 (add_momentum(term, i, own, j, pair, rates), ...);
                                 (add_viscous(term, i, own, j, pair, rates), ...);
                                 rates.close(pair, own.m[j]);
                               }
                             });
  i.p_rho2 = p_rho2_i;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    if constexpr (of_velocity<wanted>) boundaries[b].force_on_fluid.forget(cluster);
    if (!boundaries[b].acts_on(cluster)) continue;
    const auto near = boundaries[b].list_for_fluid.near(cluster);
    const Sources wall = sources(boundaries[b]);
    // Summed apart: where a wall is only grazed, its share of the acceleration is below the rounding of the
    // rest.
    const VecLanes others = std::exchange(rates.a, zero_vector());
    over_pairs(kernel, near, i, wall, [&](std::size_t j, const Pair& pair) TORYU_INLINE_LAMBDA {
      if constexpr (of_density<wanted>) (add_density_at_wall(term, i, wall, j, pair, rates), ...);
      if constexpr (of_velocity<wanted>) {
        (add_at_wall(term, i, wall, j, pair, rates), ...);
        if (sweeps.viscous_walls) (add_viscous(term, i, wall, j, pair, rates), ...);
        rates.close(pair, wall.m[j]);
      }
    });
    if constexpr (of_velocity<wanted>)
      boundaries[b].force_on_fluid.set(cluster, load(fluid.m, first), rates.a);
    for (int a = 0; a < dim; ++a) rates.a[a] += others[a];
  }
  if constexpr (of_density<wanted>) store(i.rho * rates.compression + rates.diffusion, fluid.drho, first);
  if constexpr (of_velocity<wanted>) {
    const BodyForce& f = sweeps.body_force;
    for (int a = 0; a < dim; ++a)
      store(rates.a[a] + f.gravity[a] - f.central_rate_squared * (i.x[a] - f.centre[a]), fluid.a[a], first);
  }
}

/// The momentum terms of the same pairs, gathered by one cluster of the boundary.
template <class W, class... Terms>
void reaction_on_cluster(const PairSweeps& sweeps, const W& kernel, const Particles& fluid,
                         Boundary& boundary, std::size_t cluster, const Terms... term) {
  const std::size_t first = cluster * lane_count;
  const Sources own = sources(fluid);
  Targets w = load_targets(boundary, first);
  Rates rates;
  over_pairs(kernel, boundary.list_for_wall.near(cluster), w, own,
             [&](std::size_t i, const Pair& pair) TORYU_INLINE_LAMBDA {
               (add_at_wall(term, w, own, i, pair, rates), ...);
               if (sweeps.viscous_walls) (add_viscous(term, w, own, i, pair, rates), ...);
               rates.close(pair, own.m[i]);
             });
  for (int a = 0; a < dim; ++a) store(load(boundary.m, first) * rates.a[a], boundary.force[a], first);
}

template <RatesOf wanted, class W, class... Terms>
void rates_of_all(const PairSweeps& sweeps, const W& kernel, Particles& fluid, const ClusterList& neighbours,
                  std::vector<Boundary>& boundaries, const std::vector<std::uint32_t>* some,
                  const Terms... term) {
  const std::size_t count = some ? some->size() : fluid.clusters();
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t k = 0; k < count; ++k)
    rates_of_cluster<wanted>(sweeps, kernel, fluid, neighbours, boundaries, some ? (*some)[k] : k, term...);
}

}  // namespace

template <class W>
void PairSweeps::rates(const W& kernel, RatesOf wanted, Particles& fluid, const ClusterList& neighbours,
                       std::vector<Boundary>& boundaries, const std::vector<std::uint32_t>* some) const {
  if (axisymmetric) return rates_about_axis(kernel, wanted, fluid, neighbours, boundaries);
  // Terms that a sweep does not ask for are not told apart: each combination is compiled once.
  if (wanted == RatesOf::both)
    std::visit(
        [&](const auto&... term) {
          rates_of_all<RatesOf::both>(*this, kernel, fluid, neighbours, boundaries, some,
                                      Continuity{rest_density, wall_suction}, Pressure{wall_suction},
                                      term...);
        },
        terms.diffusion, terms.artificial, terms.viscous, terms.repulsion);
  else if (wanted == RatesOf::velocity)
    std::visit(
        [&](const auto&... term) {
          rates_of_all<RatesOf::velocity>(*this, kernel, fluid, neighbours, boundaries, some,
                                          Pressure{wall_suction}, term...);
        },
        terms.artificial, terms.viscous, terms.repulsion);
  else
    std::visit(
        [&](const auto& diffusion) {
          rates_of_all<RatesOf::density>(*this, kernel, fluid, neighbours, boundaries, some,
                                         Continuity{rest_density, wall_suction}, diffusion);
        },
        terms.diffusion);
}

template <class W>
void PairSweeps::rates_about_axis(const W& kernel, RatesOf wanted, Particles& fluid,
                                  const ClusterList& neighbours, std::vector<Boundary>& boundaries) const {
  const auto sweep = [&]<RatesOf these>(const auto&... term) {
    rates_of_all<these>(*this, kernel, fluid, neighbours, boundaries, nullptr, term...);
  };
  if (wanted != RatesOf::velocity)
    std::visit(
        [&](const auto& diffusion) {
          sweep.template operator()<RatesOf::density>(RingContinuity{}, in_rings(diffusion));
        },
        terms.diffusion);
  if (wanted != RatesOf::density)
    std::visit(
        [&](const auto& viscous) {
          sweep.template operator()<RatesOf::velocity>(RingPressure{}, in_rings(viscous));
        },
        terms.viscous);
}

template <class W>
void PairSweeps::reaction(const W& kernel, const Particles& fluid, Boundary& boundary) const {
  for (auto& component : boundary.force) component.assign(boundary.V.size(), 0.0);
  const auto& active = boundary.list_for_wall.active();
  std::visit(
      [&](const auto&... term) {
#pragma omp parallel for schedule(dynamic, 4)
        for (std::size_t k = 0; k < active.size(); ++k)
          reaction_on_cluster(*this, kernel, fluid, boundary, active[k], Pressure{wall_suction}, term...);
      },
      terms.artificial, terms.viscous, terms.repulsion);
}

}  // namespace toryu::fluid
