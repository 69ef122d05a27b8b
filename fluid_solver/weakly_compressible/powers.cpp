/// What each term takes from the energy of the fluid, see energy_balance.hpp. A term is summed in a loop of
/// its own: the loops by which the fluid advances carry nothing of it.

#include <utility>

#include "fluid_solver/terms/axisymmetry.hpp"
#include "fluid_solver/terms/continuity.hpp"
#include "fluid_solver/terms/pressure.hpp"
#include "fluid_solver/weakly_compressible/dynamics.hpp"
#include "fluid_solver/weakly_compressible/further_forces.hpp"
#include "fluid_solver/weakly_compressible/polymer.hpp"

namespace toryu::fluid {

namespace {

struct Bodies {
  const Particles& fluid;
  const ClusterList& neighbours;
  const std::vector<Boundary>& boundaries;
  bool axisymmetric;
  const Ranks* ranks;
};

/// Calls of_cluster(c) for each cluster whose particles count.
template <class OfCluster>
void for_each_cluster(const Bodies& bodies, OfCluster&& of_cluster) {
  const auto* some = bodies.ranks ? &bodies.ranks->swept().own : nullptr;
  const std::size_t count = some ? some->size() : bodies.fluid.clusters();
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t k = 0; k < count; ++k) of_cluster(some ? (*some)[k] : k);
}

/// Values of the particles as those of the whole fluid.
Field of_whole(const Bodies& bodies, Field values) {
  return bodies.ranks ? bodies.ranks->of_whole(values) : std::move(values);
}

/// Sums what `of_cluster(c)` gives for the particles of a cluster, cluster by cluster of the whole fluid:
/// in the same order whatever the threads and ranks.
template <class OfCluster>
double sum_over_clusters(const Bodies& bodies, OfCluster&& of_cluster) {
  Field values(padded(bodies.fluid.count));
  for_each_cluster(bodies, [&](std::size_t c) { store(of_cluster(c), values, c * lane_count); });
  values = of_whole(bodies, std::move(values));
  double sum = 0;
  for (std::size_t first = 0; first < values.size(); first += lane_count) sum += sum_of(load(values, first));
  return sum;
}

/// - sum F_ij . v_ij over the pairs of the fluid and those with its boundaries. About an axis the two of a
/// pair are not equal and opposite across it, and - sum F_ij . v_i is the same. `between(c)` gives the force
/// as cluster c feels it, with functions as those of further_forces.hpp.
template <class W, class Between>
double power_of_pairs(const W& kernel, const Bodies& bodies, Between&& between) {
  const Particles& fluid = bodies.fluid;  // a name that lambdas may capture
  const Sources own = sources(fluid);
  const bool axisymmetric = bodies.axisymmetric;
  return sum_over_clusters(bodies, [&](std::size_t c) {
    const auto force = between(c);
    const Targets i = load_targets(fluid, c * lane_count);
    Lanes of_fluid = 0.0, of_walls = 0.0;
    if constexpr (requires(const Pair& pair, Rates& rates) { force.momentum(i, own, 0, pair, rates); })
      over_pairs<PairsOf::fluid>(kernel, bodies.neighbours.near(c), i, own,
                                 [&](std::uint32_t j, const Pair& pair) TORYU_INLINE_LAMBDA {
                                   Rates rates;
                                   force.momentum(i, own, j, pair, rates);
                                   rates.close(pair, own.m[j]);
                                   of_fluid += dot(rates.a, axisymmetric ? product(2.0, i.v) : pair.v_ij);
                                 });
    if constexpr (requires(const Pair& pair, Rates& rates) { force.at_wall(i, own, 0, pair, rates); })
      for (const Boundary& boundary : bodies.boundaries) {
        const Sources wall = sources(boundary);
        over_pairs(kernel, boundary.list_for_fluid.near(c), i, wall,
                   [&](std::uint32_t j, const Pair& pair) TORYU_INLINE_LAMBDA {
                     Rates rates;
                     force.at_wall(i, wall, j, pair, rates);
                     rates.close(pair, wall.m[j]);
                     of_walls += dot(rates.a, pair.v_ij);
                   });
      }
    // each pair of the fluid is met from both sides
    return -(load(fluid.m, c * lane_count) * (0.5 * of_fluid + of_walls));
  });
}

/// A viscous term as such a force; it acts at walls where they have no slip.
template <class Term>
struct Viscous {
  const Term& term;
  bool at_walls;
  TORYU_INLINE void momentum(const Targets& i, const Sources& s, std::uint32_t j, const Pair& pair,
                             Rates& rates) const {
    term.viscous(i, s, j, pair, rates);
  }
  TORYU_INLINE void at_wall(const Targets& i, const Sources& s, std::uint32_t j, const Pair& pair,
                            Rates& rates) const {
    if (at_walls) term.viscous(i, s, j, pair, rates);
  }
};

/// - sum_i m_i p_i/rho_i^2 D_i.
template <class W, class Term>
double power_of_diffusion(const W& kernel, const Bodies& bodies, const EquationOfState& state,
                          const Term& term) {
  const Particles& fluid = bodies.fluid;
  const Sources own = sources(fluid);
  Field p_rho(padded(fluid.count)), diffusion(padded(fluid.count));  // m p/rho^2; D
  for_each_cluster(bodies, [&](std::size_t c) {
    const Targets i = load_targets(fluid, c * lane_count);
    Rates rates;
    over_pairs<PairsOf::fluid>(kernel, bodies.neighbours.near(c), i, own,
                               [&](std::uint32_t j, const Pair& pair)
                                   TORYU_INLINE_LAMBDA { term.diffusion(i, own, j, pair, rates); });
    store(rates.diffusion, diffusion, c * lane_count);
    for (std::size_t k = c * lane_count; k < std::min((c + 1) * lane_count, fluid.count); ++k)
      p_rho[k] = fluid.m[k] * state.pressure(fluid.rho[k]) / (fluid.rho[k] * fluid.rho[k]);
  });
  p_rho = of_whole(bodies, std::move(p_rho)), diffusion = of_whole(bodies, std::move(diffusion));
  double sum = 0;
  for (std::size_t first = 0; first < p_rho.size(); first += lane_count) {
    double of_cluster = 0;
    for (std::size_t k = first; k < first + lane_count; ++k) of_cluster -= p_rho[k] * diffusion[k];
    sum += of_cluster;
  }
  return sum;
}

/// What is lost where the fluid meets walls: sum_w F_iw . v_iw by pressure, less what density gains there.
template <class W, class PressureTerm, class ContinuityTerm>
double power_of_walls(const W& kernel, const Bodies& bodies, const PressureTerm& pressure,
                      const ContinuityTerm& continuity) {
  const Particles& fluid = bodies.fluid;
  return sum_over_clusters(bodies, [&](std::size_t c) {
    const Targets i = load_targets(fluid, c * lane_count);
    Lanes of_pressure = 0.0;
    Rates density;
    for (const Boundary& boundary : bodies.boundaries) {
      const Sources wall = sources(boundary);
      over_pairs(kernel, boundary.list_for_fluid.near(c), i, wall,
                 [&](std::uint32_t j, const Pair& pair) TORYU_INLINE_LAMBDA {
                   Rates rates;
                   pressure.at_wall(i, wall, j, pair, rates);
                   rates.close(pair, wall.m[j]);
                   of_pressure += dot(rates.a, pair.v_ij);
                   continuity.density_at_wall(i, wall, j, pair, density);
                 });
    }
    return -(load(fluid.m, c * lane_count) * (of_pressure + i.p_rho2 * i.rho * density.compression));
  });
}

/// What the pressure takes from the motion of the fluid beyond what it stores as compression. Between
/// particles of one density it is nothing; else one force is a gradient at p/rho^2 and one rate that at
/// p/rho,
///
///     - sum_i<j m_i m_j (rho_i - rho_j)/(rho_i rho_j) (p_i/rho_i - p_j/rho_j) v_ij . gradW_ij
///
/// As a difference of two large sums it takes one density for both, that of the evaluation.
template <class W, class PressureTerm, class ContinuityTerm>
double power_of_pressure(const W& kernel, const Bodies& bodies, const PressureTerm& pressure,
                         const ContinuityTerm& continuity) {
  const Particles& fluid = bodies.fluid;
  const Sources own = sources(fluid);
  const bool axisymmetric = bodies.axisymmetric;
  return sum_over_clusters(bodies, [&](std::size_t c) {
    const Targets i = load_targets(fluid, c * lane_count);
    const Lanes m = load(fluid.m, c * lane_count);
    Lanes rho = m * inverse(max(load(fluid.V, c * lane_count), 1e-300));
    if (axisymmetric) rho *= inverse(circumference(i.x[1]));
    Lanes of_pressure = 0.0;
    Rates density;
    over_pairs<PairsOf::fluid>(kernel, bodies.neighbours.near(c), i, own,
                               [&](std::uint32_t j, const Pair& pair) TORYU_INLINE_LAMBDA {
                                 Rates rates;
                                 pressure.momentum(i, own, j, pair, rates);
                                 rates.close(pair, own.m[j]);
                                 of_pressure += dot(rates.a, axisymmetric ? product(2.0, i.v) : pair.v_ij);
                                 continuity.density(i, own, j, pair, density);
                               });
    return -(m * (0.5 * of_pressure + i.p_rho2 * rho * density.compression));
  });
}

template <class Term>
constexpr bool is_there = !std::is_same_v<Term, Absent>;

}  // namespace

std::vector<Power> Dynamics::powers(const Particles& fluid, const ClusterList& neighbours,
                                    const std::vector<Boundary>& boundaries, const Ranks* ranks) const {
  const Bodies bodies{fluid, neighbours, boundaries, axisymmetric(), ranks};
  const bool known = neighbours.clusters() > 0;  // before the first step nobody knows who is near
  std::vector<Power> found;
  const auto note = [&](const char* term, Taken taken, auto&& power) {
    const auto of_kernel = [&](const auto& W) { return known ? power(W) : 0.0; };
    found.push_back({term, taken, medium_.kernel.visit(of_kernel)});
  };
  const auto note_viscous = [&](const char* name, const auto& chosen) {
    std::visit(
        [&]<class Term>(const Term& term) {
          if constexpr (is_there<Term>)
            note(name, Taken::dissipated, [&](const auto& W) {
              const auto power = [&]<class Here>(const Here& here) {
                return power_of_pairs(W, bodies, [&](auto) { return Viscous<Here>{here, viscous_walls()}; });
              };
              return axisymmetric() ? power(in_rings(term)) : power(term);
            });
        },
        chosen);
  };
  if (!boundaries.empty())
    note("walls", Taken::dissipated, [&](const auto& W) {
      const bool suction = parameters_.wall_model.suction;
      if (axisymmetric()) return power_of_walls(W, bodies, RingPressure{}, RingContinuity{});
      return power_of_walls(W, bodies, Pressure(suction), Continuity(parameters_.density, suction));
    });
  std::visit(
      [&]<class Term>(const Term& term) {
        if constexpr (is_there<Term>)
          note(DensityDiffusion::section, Taken::dissipated, [&](const auto& W) {
            return axisymmetric() ? power_of_diffusion(W, bodies, state_, in_rings(term))
                                  : power_of_diffusion(W, bodies, state_, term);
          });
      },
      terms_.diffusion);
  note_viscous(ArtificialViscosity::section, terms_.artificial);
  note_viscous("viscosity", terms_.viscous);
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (known && parameters_.laminar_viscosity && boundaries[b].turns())
      found.back().value += boundaries[b].angular_velocity * moment_beside_pairs(fluid, boundaries, b, ranks);
  if (friction_)
    note(Friction::section, Taken::dissipated, [&](const auto&) {
      return friction_->power(fluid, pressure_offset(fluid, boundaries, ranks), boundaries, ranks);
    });
  std::visit(
      [&]<class Term>(const Term& term) {
        if constexpr (is_there<Term>)
          note(WallRepulsion::section, Taken::stored,
               [&](const auto& W) { return power_of_pairs(W, bodies, [&](auto) { return term; }); });
      },
      terms_.repulsion);
  for_each_term(parameters_, [&]<class Term>(const std::optional<Term>& term) {
    if constexpr (requires { pair_force(*term, medium_); })
      if (term) {
        double dissipated = 0;
        if constexpr (requires { dissipated_power(*term, fluid, ranks); }) {
          dissipated = dissipated_power(*term, fluid, ranks);
          note(Term::section, Taken::dissipated, [&](const auto&) { return dissipated; });
        }
        note(Term::section, Taken::stored, [&](const auto& W) {
          auto force = pair_force(*term, medium_);
          if constexpr (requires { force.prepare(W, fluid, neighbours, boundaries); })
            force.prepare(W, fluid, neighbours, boundaries);
          return power_of_pairs(W, bodies, [&](std::size_t c) { return seen_from(force, c * lane_count); }) -
                 dissipated;
        });
      }
  });
  note("pressure", Taken::dissipated, [&](const auto& W) {
    return axisymmetric() ? power_of_pressure(W, bodies, RingPressure{}, RingContinuity{})
                          : power_of_pressure(W, bodies, Pressure{}, Continuity{});
  });
  return found;
}

}  // namespace toryu::fluid
