/// Forces between pairs beyond those that are joined in one loop (pair_sweeps.hpp): each is a loop of its
/// own. A factor more in the joined loop would double the number of loops to compile; a loop more costs a run
/// that has the term about a third of the joined one, and a run that has not, nothing. Measured with surface
/// tension, which takes two loops, on a drop of 14,000 particles: 420 instead of 292 ns of processor time per
/// particle and evaluation, where the joined loop takes some 200 (four runs with and four without in turn,
/// within 2 %; EPYC with AVX-512, commit a4fdf29):
///
///     fluid_solver cases/capillary_drop/case.toml --threads 1 --end-time 3e-4 --set fluid.spacing=1.5e-5
///         --set case.frame_interval=0 --set fluid.integrator=midpoint
///         --set fluid.artificial_viscosity.alpha=0.02 [--set fluid.surface_tension=false]
///
/// A term of terms.hpp acts here if there is a function `pair_force(term, medium)`, which returns a force
/// with
///
///     momentum(i, sources, j, pair, rates)       between particles of the fluid: adds to rates.a
///     at_wall(i, sources, j, pair, rates)        the same with a boundary, on either side; may be absent
///     prepare(W, fluid, neighbours, boundaries)  finds fields of the force's own before; may be absent
///     seen_from(first)                           what the particles from number `first` on feel, with the
///                                                fields there in lanes; without it the force itself
///
/// A force lives for one evaluation, and so do its fields: they belong to no state and need no place in
/// particles.hpp.
#pragma once

#include "fluid_solver/parameters.hpp"
#include "fluid_solver/weakly_compressible/pair_loop.hpp"

namespace toryu::fluid {

/// Calls visit(force) for each term of the case that is such a force.
template <class Visit>
void for_each_further_force(const OptionalTerms& terms, const Medium& medium, Visit&& visit) {
  for_each_term(terms, [&](const auto& term) {
    if constexpr (requires { pair_force(*term, medium); })
      if (term) {
        auto force = pair_force(*term, medium);
        visit(force);
      }
  });
}

/// `force` as the particles from number `first` on feel it.
template <class Force>
auto seen_from(const Force& force, std::size_t first) {
  if constexpr (requires { force.seen_from(first); })
    return force.seen_from(first);
  else
    return force;
}

/// What a force does to one cluster of `fluid`, and what of it each boundary did.
template <class W, class Force>
void add_to_cluster(const W& kernel, const Force& of_all, Particles& fluid, const ClusterList& neighbours,
                    std::vector<Boundary>& boundaries, std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const auto force = seen_from(of_all, first);
  const Targets i = load_targets(fluid, first);
  const Sources own = sources(fluid);
  Rates rates;
  over_pairs(kernel, neighbours.near(cluster), i, own,
             [&](std::size_t j, const Pair& pair)
                 TORYU_INLINE_LAMBDA { force.momentum(i, own, j, pair, rates); });
  if constexpr (requires(const Sources& wall, const Pair& pair) { force.at_wall(i, wall, 0, pair, rates); })
    for (Boundary& boundary : boundaries) {
      const Sources wall = sources(boundary);
      Rates by_wall;
      over_pairs(kernel, boundary.list_for_fluid.near(cluster), i, wall,
                 [&](std::size_t j, const Pair& pair)
                     TORYU_INLINE_LAMBDA { force.at_wall(i, wall, j, pair, by_wall); });
      boundary.force_on_fluid.add(cluster, load(fluid.m, first), by_wall.a);
      for (int a = 0; a < dim; ++a) rates.a[a] += by_wall.a[a];
    }
  for (int a = 0; a < dim; ++a) store(load(fluid.a[a], first) + rates.a[a], fluid.a[a], first);
}

/// Adds all of them to the accelerations of `fluid`, and to what each boundary did to it; with `some`, of
/// these clusters.
template <class W>
void add_further_forces(const W& kernel, const OptionalTerms& terms, const Medium& medium, Particles& fluid,
                        const ClusterList& neighbours, std::vector<Boundary>& boundaries,
                        const std::vector<std::uint32_t>* some) {
  const std::size_t count = some ? some->size() : fluid.clusters();
  for_each_further_force(terms, medium, [&](auto& force) {
    if constexpr (requires { force.prepare(kernel, fluid, neighbours, boundaries); })
      force.prepare(kernel, fluid, neighbours, boundaries);
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t k = 0; k < count; ++k)
      add_to_cluster(kernel, force, fluid, neighbours, boundaries, some ? (*some)[k] : k);
  });
}

/// Adds the exact reaction to `boundary.force`, gathered pair by pair on the boundary's side.
template <class W>
void add_further_reactions(const W& kernel, const OptionalTerms& terms, const Medium& medium,
                           const Particles& fluid, Boundary& boundary) {
  const auto& active = boundary.list_for_wall.active();
  for_each_further_force(terms, medium, [&](const auto& force) {
    if constexpr (requires(const Targets& w, const Sources& own, const Pair& pair, Rates& rates) {
                    force.at_wall(w, own, 0, pair, rates);
                  }) {
#pragma omp parallel for schedule(dynamic, 4)
      for (std::size_t k = 0; k < active.size(); ++k) {
        const std::size_t first = active[k] * lane_count;
        const Targets w = load_targets(boundary, first);
        const Sources own = sources(fluid);
        Rates rates;
        over_pairs(kernel, boundary.list_for_wall.near(active[k]), w, own,
                   [&](std::size_t i, const Pair& pair)
                       TORYU_INLINE_LAMBDA { force.at_wall(w, own, i, pair, rates); });
        for (int a = 0; a < dim; ++a)
          store(load(boundary.force[a], first) + load(boundary.m, first) * rates.a[a], boundary.force[a],
                first);
      }
    }
  });
}

}  // namespace toryu::fluid
