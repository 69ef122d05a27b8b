/// Small solids for the tests.
#pragma once

#include <gtest/gtest.h>

#include "solid_solver/make_model.hpp"

namespace toryu::solid {

/// Geometry that the test knows to be right.
inline Body body_of(const Parameters& parameters) {
  return build_body(parameters, [](const std::string& key, const std::string& message) {
    ADD_FAILURE() << key << ": " << message;
  });
}

/// A plate of `rows` rows, 0.02 m thick and 0.08 m long, rubber-like: E = 2 MPa, nu = 0.4, held nowhere.
inline Parameters free_plate(int rows) {
  Parameters p;
  p.material = {.density = 1000, .youngs_modulus = 2e6, .poissons_ratio = 0.4};
  p.spacing = 0.02 / rows;
  p.regions = {{"plate", {Vec(0, 0), Vec(0.08, 0.02)}}};
  p.hourglass = HourglassPenalty{};
  return p;
}

/// The same, moving in its first mode and held in its first row of cells.
inline Parameters moving_cantilever(int rows, double tip_speed) {
  Parameters p = free_plate(rows);
  p.clamps = {{"root", {Vec(-1, -1), Vec(p.spacing, 1)}}};
  p.initial_velocity = InitialVelocity{VelocityProfile::cantilever_mode_1, Vec(0, tip_speed),
                                       Vec(p.spacing, 0), 0.08 - p.spacing};
  return p;
}

inline Scene empty_scene() {
  Scene scene;
  scene.domain = {Vec(-1, -1), Vec(1, 1)};
  return scene;
}

inline std::unique_ptr<SolidModel> model_of(const Parameters& parameters,
                                            const Scene& scene = empty_scene()) {
  return make_model(parameters, body_of(parameters), scene);
}

/// Value of the column `name` [its unit].
inline double observed(const SolidModel& model, const std::string& name) {
  for (const auto& observation : model.observe())
    if (observation.name == name) return observation.value;
  ADD_FAILURE() << "no column " << name;
  return 0;
}

inline double angular_momentum(const SolidModel& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particle_count(); ++i) {
    const Vec x = model.body().X[i] + model.displacement(i), v = model.velocity(i);
    sum += model.mass(i) * (x[0] * v[1] - x[1] * v[0]);
  }
  return sum;
}

/// Advances to `time` [s] with steps of the model's own limit.
inline void run_to(SolidModel& model, double time) {
  double t = 0;
  while (t < time) {
    const double dt = std::min(model.time_step_limit(), time - t);
    model.advance(dt);
    t += dt;
  }
}

}  // namespace toryu::solid
