/// Small scenes to run the solver in.
#pragma once

#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"

namespace toryu::fluid {

/// Parameters of a fluid, and the scene it is in.
struct Setting {
  Parameters parameters;
  Scene scene;
  WeaklyCompressible solver() const { return WeaklyCompressible(parameters, scene); }
};

inline Setting empty_space() {
  Setting s;
  s.parameters.spacing = 0.05;
  s.parameters.sound_speed = 20;
  s.parameters.density_diffusion = DensityDiffusion{};
  s.parameters.artificial_viscosity = ArtificialViscosity{0.05, 0.0};
  s.scene.domain = {Vec(-10, -10), Vec(10, 10)};
  return s;
}

/// Of a viscous medium, for implicit steps.
inline Setting space_of_implicit_steps() {
  Setting s = empty_space();
  s.parameters.artificial_viscosity.reset();
  s.parameters.density_diffusion.reset();
  s.parameters.model = Model::implicit;
  s.parameters.laminar_viscosity = LaminarViscosity{2000};
  return s;
}

/// Two blocks of fluid that meet askew in empty space: all terms act, nothing outside does.
inline Setting colliding_drops() {
  Setting s = empty_space();
  s.parameters.laminar_viscosity = LaminarViscosity{2.0};
  s.parameters.regions = {{"left", {Vec(0, 0), Vec(0.5, 0.4)}, Vec(1.0, 0.1)},
                          {"right", {Vec(0.5, 0.1), Vec(0.8, 0.6)}, Vec(-1.5, 0.3)}};
  return s;
}

/// A column of water that collapses in a tank of width 1.
inline Setting collapsing_column() {
  Setting s = empty_space();
  s.scene.gravity = Vec(0, -9.81);
  s.scene.walls = {{"floor", {Vec(-0.15, -0.15), Vec(1.15, 0)}, {}},
                   {"left", {Vec(-0.15, 0), Vec(0, 1.2)}, {}},
                   {"right", {Vec(1, 0), Vec(1.15, 1.2)}, {}}};
  s.parameters.regions = {{"column", {Vec(0, 0), Vec(0.5, 0.8)}, Vec::Zero()}};
  return s;
}

/// Makes it a channel along x with open ends, of `height` [m], through which water runs.
inline void open_channel(Setting& s, double begin, double end, double height) {
  const double outer = 0.5, thickness = 0.2;  // beyond the layers, and the kernel
  s.scene.gravity = Vec::Zero();
  s.scene.walls = {{"floor", {Vec(begin - outer, -thickness), Vec(end + outer, 0)}, {}},
                   {"ceiling", {Vec(begin - outer, height), Vec(end + outer, height + thickness)}, {}}};
  s.parameters.regions = {{"water", {Vec(begin, 0), Vec(end, height)}, Vec::Zero()}};
  s.parameters.hydrostatic_start.reset();
  s.parameters.background_pressure = BackgroundPressure{3e3};
  s.parameters.inlets = {
      {{"inlet", Vec(begin, 0), Vec(begin, height)}, InflowProfile::parabolic, 1.0, 0, {}, 0, {}}};
  s.parameters.outlets = {{{"outlet", Vec(end, 0), Vec(end, height)}, 0, {}}};
}

/// What a row of the record holds, by the name of the column.
inline std::map<std::string, double> columns(const FluidModel& solver) {
  std::map<std::string, double> found;
  for (const auto& seen : solver.observe()) found[seen.name] = seen.value;
  return found;
}

inline void run_until(WeaklyCompressible& solver, double end) {
  while (solver.time() < end - 1e-12) solver.advance(std::min(solver.time_step_limit(), end - solver.time()));
}

/// Runs to `end` by steps of `share` of the limit with a row at each, the powers of every tenth.
inline std::map<std::string, double> after(WeaklyCompressible& solver, double end, double share = 1) {
  while (solver.time() < end - 1e-12) {
    solver.advance(std::min(share * solver.time_step_limit(), end - solver.time()));
    solver.record(solver.time());
  }
  return columns(solver);
}

inline Motion turning_at(double rate, const Vec& about) {
  return Motion{.rotation = Rotation{about, {.angular_velocity = {{0, rate}}}}};
}

/// A field by the particles' numbers at the start.
inline std::vector<Vec> by_id(const WeaklyCompressible& solver, const VecField& field) {
  const auto& f = solver.particles();
  std::vector<Vec> values(f.count);
  for (std::size_t k = 0; k < f.count; ++k) values[f.id[k]] = at(field, k);
  return values;
}
inline std::vector<Vec> positions(const WeaklyCompressible& solver) {
  return by_id(solver, solver.particles().x);
}

/// Largest distance of a particle between the two, or difference of its velocity.
inline double largest_difference(const std::vector<Vec>& a, const std::vector<Vec>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, (a[k] - b[k]).norm());
  return largest;
}

}  // namespace toryu::fluid
