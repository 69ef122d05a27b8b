/// That a term which a case does without costs nothing, neither time nor memory.
///
/// Time: the fluid's sweep over all pairs, with every optional term absent, against a loop written out by
/// hand that knows nothing but continuity (18) and pressure (22). Both run in turn on the same particles; the
/// median of the ratios of neighbouring runs is what counts, since other programs disturb both alike. The
/// terms one by one follow, for comparison.
///
/// Memory: what a whole solver holds after a step, a particle, with each term alone.
///
/// Ends with 1 if the loop and the sweep do not find the same rates: then they do not compute the same.
#include <fmt/format.h>
#include <malloc.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <numeric>

#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"

namespace {

using namespace toryu;
using namespace toryu::fluid;

constexpr int across = 100;  // particles of the square
constexpr double spacing = 1.0 / across, h = 1.3 * spacing, c_0 = 30.0;
constexpr int rounds = 60, sweeps_a_round = 5;

/// A square of particles in motion under pressure, without walls.
struct Square {
  Particles fluid;
  ClusterList near;

  Square() {
    fluid.count = across * across;
    const std::size_t size = padded(fluid.count);
    for (auto* field : {&fluid.x, &fluid.v, &fluid.a, &fluid.grad_rho}) resize(*field, size);
    for (auto* field : {&fluid.rho, &fluid.m, &fluid.V, &fluid.p, &fluid.p_rho2, &fluid.drho})
      field->assign(size, 0.0);
    VecField places;
    resize(places, size);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t n = std::min(k, fluid.count - 1);
      set(places, k, spacing * Vec(0.5 + n / across, 0.5 + n % across));
    }
    StripOrder strips(std::sqrt(static_cast<double>(lane_count)) * spacing);
    const auto order = strips.sort(places[0], places[1], fluid.count);
    for (std::size_t k = 0; k < size; ++k) {
      const Vec x = at(places, order[std::min(k, fluid.count - 1)]);
      set(fluid.x, k, x);
      set(fluid.v, k, Vec(std::sin(7 * x[0] + 3 * x[1]), std::cos(5 * x[1])));
      fluid.rho[k] = 1000 + 10 * std::sin(9 * x[0]);
      fluid.m[k] = 1000 * spacing * spacing;
      fluid.V[k] = fluid.m[k] / fluid.rho[k];
      fluid.p[k] = c_0 * c_0 * (fluid.rho[k] - 1000);
      fluid.p_rho2[k] = fluid.p[k] / (fluid.rho[k] * fluid.rho[k]);
    }
    strips.index(fluid.x[0], fluid.count);
    near.build(fluid.x, fluid.count, fluid.x, strips, 2 * h);
  }
};

/// Continuity and pressure by hand.
void sweep_by_hand(const CubicSpline& W, Particles& f, const ClusterList& neighbours) {
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t c = 0; c < f.clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const VecLanes x_i = load(f.x, i), v_i = load(f.v, i);
    const Lanes rho_i = load(f.rho, i), p_rho2_i = load(f.p_rho2, i);
    VecLanes a_i = zero_vector();
    Lanes compression = 0.0;
    for (const ShiftedNeighbours& near : neighbours.near(c)) {
      const VecLanes x = shifted(x_i, near.shift);
      for (const std::uint32_t j : near.sources) {
        const VecLanes x_ij{x[0] - f.x[0][j], x[1] - f.x[1][j]}, v_ij{v_i[0] - f.v[0][j], v_i[1] - f.v[1][j]};
        const Lanes r2 = max(dot(x_ij, x_ij), 1e-300), inverse_r = inverse_sqrt(r2);
        const Lanes G = W.gradient_over_r(r2 * inverse_r, inverse_r);
        compression += (f.V[j] * dot(v_ij, x_ij)) * G;
        const Lanes factor = (-f.m[j] * (p_rho2_i + f.p_rho2[j])) * G;
        for (int k = 0; k < dim; ++k) a_i[k] += factor * x_ij[k];
      }
    }
    store(rho_i * compression, f.drho, i);
    store(a_i, f.a, i);
  }
}

using Sweep = std::function<void(Square&)>;

Sweep sweep_of(const ChosenTerms& terms) {
  return [terms](Square& square) {
    const BodyForce none;
    const PairSweeps sweeps{.terms = terms,
                            .body_force = none,
                            .viscous_walls = false,
                            .wall_suction = true,
                            .rest_density = 1000,
                            .tensile_control = false};
    std::vector<Boundary> no_walls;
    sweeps.rates(CubicSpline(h), RatesOf::both, square.fluid, square.near, no_walls);
  };
}

/// Processor time of a sweep [s]: other programs on the machine disturb it less than elapsed time.
double time_of(const Sweep& sweep, Square& square) {
  const std::clock_t start = std::clock();
  for (int n = 0; n < sweeps_a_round; ++n) sweep(square);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / sweeps_a_round;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Whether both sweeps find the same rates but for rounding.
bool agree(const Sweep& a, const Sweep& b) {
  Square one, other;
  a(one);
  b(other);
  double largest = 0, difference = 0;
  const auto compare = [&](const Field& x, const Field& y) {
    for (std::size_t k = 0; k < one.fluid.count; ++k) {
      largest = std::max(largest, std::abs(x[k]));
      difference = std::max(difference, std::abs(x[k] - y[k]));
    }
  };
  for (int k = 0; k < dim; ++k) compare(one.fluid.a[k], other.fluid.a[k]);
  compare(one.fluid.drho, other.fluid.drho);
  return difference <= 1e-12 * largest;
}

void compare_times(const std::vector<std::pair<std::string, Sweep>>& sweeps) {
  Square square;
  std::vector<std::vector<double>> ratios(sweeps.size());
  double first_time = 0;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t n = 0; n < sweeps.size(); ++n) {
      // Before and after, so that a drift of the machine's speed cancels.
      const double before = time_of(sweeps[0].second, square), mine = time_of(sweeps[n].second, square),
                   after = time_of(sweeps[0].second, square);
      if (round == 0) continue;
      ratios[n].push_back(2 * mine / (before + after));
      first_time = before;
    }
  fmt::print("{:<44} {:>22}\n", "one sweep over the pairs of the fluid", "time over the first");
  for (std::size_t n = 0; n < sweeps.size(); ++n)
    fmt::print("{:<44} {:>22.3f}\n", sweeps[n].first, median(ratios[n]));
  fmt::print("first: {:.0f} ns a particle\n\n", 1e9 * first_time / (across * across));
}

double held_bytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Bytes a particle of a tank of water after a step.
double memory_of(const std::function<void(Parameters&)>& add) {
  Parameters p;
  p.spacing = spacing;
  p.sound_speed = c_0;
  p.regions.push_back({"water", {Vec(0, 0), Vec(1, 1)}, Vec::Zero()});
  add(p);
  Scene scene;
  scene.gravity = Vec(0, -9.81);
  scene.domain = {Vec(-1, -1), Vec(2, 2)};
  const double w = 3 * spacing;
  scene.walls = {{"floor", {Vec(-w, -w), Vec(1 + w, 0)}, {}}};
  const double before = held_bytes();
  WeaklyCompressible fluid(p, scene);
  fluid.advance(fluid.time_step_limit());
  return (held_bytes() - before) / static_cast<double>(fluid.particle_count());
}

void compare_memory() {
  const std::pair<const char*, std::function<void(Parameters&)>> cases[] = {
      {"no optional term", [](Parameters&) {}},
      {"density diffusion, plain",
       [](Parameters& p) { p.density_diffusion.emplace().gradient = DiffusionGradient::none; }},
      {"density diffusion, renormalised", [](Parameters& p) { p.density_diffusion.emplace(); }},
      {"artificial viscosity", [](Parameters& p) { p.artificial_viscosity.emplace(); }},
      {"laminar viscosity", [](Parameters& p) { p.laminar_viscosity.emplace().dynamic_viscosity = 1; }},
      {"power law",
       [](Parameters& p) {
         p.power_law = PowerLaw{1, 0.5, 0.1, 10};
       }},
      {"particle shifting", [](Parameters& p) { p.particle_shifting.emplace(); }},
      {"tensile control", [](Parameters& p) { p.tensile_control.emplace(); }},
      {"consistent gradients", [](Parameters& p) { p.consistent_gradients.emplace(); }}};
  fmt::print("{:<44} {:>22}\n", "solver after a step", "bytes a particle");
  memory_of(cases[0].second);  // what the first solver of a process allocates for good
  for (const auto& [name, add] : cases) fmt::print("{:<44} {:>22.0f}\n", name, memory_of(add));
}

}  // namespace

int main() {
  omp_set_num_threads(1);
  const Sweep by_hand = [](Square& square) { sweep_by_hand(CubicSpline(h), square.fluid, square.near); };
  ChosenTerms none, plain, renormalised, artificial, laminar;
  plain.diffusion = DensityDiffusionTerm<false>{0.1 * h * c_0};
  renormalised.diffusion = DensityDiffusionTerm<true>{0.1 * h * c_0};
  artificial.artificial = ArtificialViscosityTerm{0.1, 0.0, h, c_0};
  laminar.viscous = LaminarViscosityTerm{1.0};
  if (!agree(by_hand, sweep_of(none))) {
    fmt::print("the loop by hand and the sweep find different rates\n");
    return 1;
  }
  compare_times({{"continuity and pressure, written by hand", by_hand},
                 {"all optional terms absent", sweep_of(none)},
                 {"density diffusion, plain", sweep_of(plain)},
                 {"density diffusion, renormalised", sweep_of(renormalised)},
                 {"artificial viscosity", sweep_of(artificial)},
                 {"laminar viscosity", sweep_of(laminar)}});
  compare_memory();
  return 0;
}
