/// Time of one evaluation of the solid's forces, both formulations, in whole steps: one evaluation each in
/// total Lagrangian form, two in updated form. The counter `ns_per_particle` is what the README quotes.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>

#include "solid_solver/make_model.hpp"

namespace toryu::solid {
namespace {

/// A plate of 10 : 1 with about `count` particles in its first mode.
std::unique_ptr<SolidModel> plate(int count, Formulation formulation) {
  const int rows = static_cast<int>(std::lround(std::sqrt(count / 10.0)));
  Parameters p;
  p.formulation = formulation;
  p.material = {.density = 1000, .youngs_modulus = 2e6, .poissons_ratio = 0.4};
  p.spacing = 0.02 / rows;
  p.regions = {{"plate", {Vec(0, 0), Vec(0.2, 0.02)}}};
  p.clamps = {{"root", {Vec(0, 0), Vec(4 * p.spacing, 0.02)}}};
  p.initial_velocity = InitialVelocity{VelocityProfile::cantilever_mode_1, Vec(0, 0.5), Vec(0, 0), 0.2};
  if (formulation == Formulation::total_lagrangian) {
    p.hourglass = HourglassPenalty{};
  } else {
    p.artificial_viscosity = ArtificialViscosity{};
    p.artificial_stress = ArtificialStress{};
    p.gradients = Gradients::renormalised;
  }
  Scene scene;
  scene.domain = {Vec(-1, -1), Vec(1, 1)};
  return make_model(p, build_body(p, [](const std::string&, const std::string&) {}), scene);
}

void step(benchmark::State& state, Formulation formulation) {
  omp_set_num_threads(1);
  const auto model = plate(static_cast<int>(state.range(0)), formulation);
  const double dt = model->time_step_limit();
  for (auto _ : state) model->advance(dt);
  const double evaluations = formulation == Formulation::total_lagrangian ? 1 : 2;
  state.counters["ns_per_particle"] =
      benchmark::Counter(1e-9 * evaluations * static_cast<double>(model->particle_count()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["particles"] = static_cast<double>(model->particle_count());
}

void total_lagrangian(benchmark::State& state) {
  step(state, Formulation::total_lagrangian);
}
void updated_lagrangian(benchmark::State& state) {
  step(state, Formulation::updated_lagrangian);
}

BENCHMARK(total_lagrangian)->Arg(1000)->Arg(4000)->Arg(10000)->Unit(benchmark::kMicrosecond);
BENCHMARK(updated_lagrangian)->Arg(1000)->Arg(4000)->Arg(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace toryu::solid
