/// Two sides of which all is known, for the tests of what couples them: a mass on a spring in a fluid that
/// resists its acceleration. Together they are
///
///     (m + m_a) x'' = p - k x,   from rest x = p/k (1 - cos(omega t)),   omega^2 = k/(m + m_a)
///
/// One particle moves along x. A window's constant force f moves the mass by f dt^2/(2 m), so the answer to a
/// guess turns it round, m_a/(2 m) times as far: the serial explicit scheme bears m_a < 2 m, whatever dt is.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "common/link/coupling_port.hpp"

namespace toryu {

struct AnalyticSides final : CouplingPort {
  double mass = 1, stiffness = 4 * M_PI * M_PI;  ///< m [kg/m], k [N/m2]: a period of 1 s in vacuum
  double added_mass = 0.5, push = 0.01;          ///< m_a [kg/m], p [N/m]
  double time_step_limit = 0.01;                 ///< [s]
  double impulse_lost = 0;                       ///< share of the impulse that the solid does not take
  std::function<void(const std::string& side, const Window& window)> before_answer = [](auto&, auto&) {};
  std::filesystem::path out;          ///< the results folder, where checkpoints lie
  std::vector<std::string> failures;  ///< of a checkpoint
  bool asked_to_stop = false;

  double coupled_position(double time) const {
    return push / stiffness * (1 - std::cos(std::sqrt(stiffness / (mass + added_mass)) * time));
  }
  double coupled_amplitude() const { return 2 * push / stiffness; }

  CouplingStart start() const {
    return {
        {.reach = 0.1, .time_step_limit = time_step_limit, .density = 1, .sound_speed = 1, .spacing = 1},
        {.id = {7}, .position = {0, 0}, .volume = {1}, .area_vector = {0, 0}, .mass = {mass}, .spacing = 1},
        {{0, 0}, {0, 0}}};
  }

  void grant_fluid(const Window& window, const InterfaceMotion& motion) override {
    calls.push_back("fluid " + std::to_string(window.number));
    target = motion.position[0];
  }
  FluidAnswer await_fluid(const Window& window) override {
    before_answer("fluid", window);
    if (window.iteration == 0) copy_at_start = copy;
    const double velocity = (target - copy_at_start.x) / window.dt;
    const double force = push - added_mass * (velocity - copy_at_start.v) / window.dt;
    copy = {target, velocity};
    return {.load = {{force}, {force, 0}, {}, Vec(-force * window.dt, 0)},
            .time_step_limit = time_step_limit,
            .health = {.compute_time = 1e-3}};
  }

  void grant_solid(const Window& window, const InterfaceLoad& load) override {
    calls.push_back("solid " + std::to_string(window.number));
    force_on_solid = load.force[0];
  }
  /// The exact answer to a constant force.
  SolidAnswer await_solid(const Window& window) override {
    before_answer("solid", window);
    if (window.iteration == 0) solid_at_start = solid;
    const double omega = std::sqrt(stiffness / mass), rest = force_on_solid / stiffness;
    const double s = std::sin(omega * window.dt), c = std::cos(omega * window.dt);
    const auto [x, v] = solid_at_start;
    solid = {rest + (x - rest) * c + v / omega * s, v * c - (x - rest) * omega * s};
    return {.motion = {{solid.x, 0}, {solid.v, 0}},
            .impulse_taken = Vec((1 - impulse_lost) * force_on_solid * window.dt, 0),
            .health = {.kinetic_energy = 0.5 * mass * solid.v * solid.v, .compute_time = 1e-3}};
  }

  std::vector<std::string> write_checkpoint(const Window& window, const std::string& folder) override {
    before_answer("checkpoint", window);
    std::ofstream(out / folder / "fluid.state", std::ios::binary).write(bytes(copy), sizeof copy);
    std::ofstream(out / folder / "solid.state", std::ios::binary).write(bytes(solid), sizeof solid);
    return failures;
  }
  void read_checkpoint(const std::filesystem::path& folder) {
    std::ifstream(folder / "fluid.state", std::ios::binary).read(bytes(copy), sizeof copy);
    std::ifstream(folder / "solid.state", std::ios::binary).read(bytes(solid), sizeof solid);
  }
  bool interrupted() const override { return asked_to_stop; }

  struct Point {
    double x = 0, v = 0;
  };
  static char* bytes(Point& point) { return reinterpret_cast<char*>(&point); }

  Point copy, copy_at_start, solid, solid_at_start;
  double target = 0, force_on_solid = 0;
  std::vector<std::string> calls;
};

}  // namespace toryu
