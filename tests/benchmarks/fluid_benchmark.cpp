/// Time of one evaluation of the fluid's rates: delta-SPH with renormalised gradient, artificial viscosity,
/// walls. `ns_per_particle` is of elapsed time, `cpu_ns_per_particle` of processor time summed over the
/// threads, which other programs on the machine disturb less: what VALIDATION.md quotes.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"

namespace toryu::fluid {
namespace {

/// A tank of n x n particles at rest under gravity, walls on three sides.
std::pair<Parameters, Scene> tank(int n) {
  Parameters p;
  p.spacing = 1.0 / n;
  p.sound_speed = 30.0;
  p.regions.push_back({"water", {Vec(0, 0), Vec(1, 1)}, Vec::Zero()});
  p.hydrostatic_start = HydrostaticStart{1.0};
  p.density_diffusion = DensityDiffusion{};
  p.artificial_viscosity = ArtificialViscosity{};
  Scene scene;
  scene.gravity = Vec(0, -9.81);
  scene.domain = {Vec(-1, -1), Vec(2, 2)};
  const double w = 3 * p.spacing;
  scene.walls = {{"left", {Vec(-w, -w), Vec(0, 1.2)}, {}},
                 {"right", {Vec(1, -w), Vec(1 + w, 1.2)}, {}},
                 {"floor", {Vec(0, -w), Vec(1, 0)}, {}}};
  return {p, scene};
}

/// Whole steps, neighbour lists and everything else included: two evaluations each.
void step(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  const auto [parameters, scene] = tank(static_cast<int>(state.range(0)));
  WeaklyCompressible fluid(parameters, scene);
  double evaluations = 0;
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::clock_t cpu_start = std::clock();
  for (auto _ : state) {
    fluid.advance(fluid.time_step_limit());
    evaluations += 2;
  }
  const double time = std::chrono::duration<double>(Clock::now() - start).count();
  const double cpu_time = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  const auto n = static_cast<double>(fluid.particle_count());
  state.counters["particles"] = n;
  state.counters["ns_per_particle"] = 1e9 * time / (n * evaluations);
  state.counters["cpu_ns_per_particle"] = 1e9 * cpu_time / (n * evaluations);
}
BENCHMARK(step)->Args({100, 1})->Args({100, 2})->Args({316, 1})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace toryu::fluid
