/// Two sides that can feed each other: a column of compressible fluid with a wall at its far end, and a mass
/// on a spring at the near one. In units of the fluid, whose density, spacing and speed of sound are 1: cells
/// of mass 1 with springs of stiffness 1 between them, computed as the symplectic fluid step does it (the
/// strain carried by its rate) and damped a little.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/link/coupling_port.hpp"

namespace toryu {

struct AcousticSides final : CouplingPort {
  static constexpr std::size_t cells = 40;
  static constexpr double viscosity = 0.1;

  AcousticSides(double mass, double stiffness, double step) : m(mass), k(stiffness), dt(step) {}

  CouplingStart start() const {
    return {{.reach = 2.5, .time_step_limit = dt, .density = 1, .sound_speed = 1, .spacing = 1},
            {.id = {7}, .position = {0, 0}, .volume = {1}, .area_vector = {1, 0}, .mass = {m}, .spacing = 1},
            {{x, 0}, {v, 0}}};
  }

  /// Of both [J/m].
  double energy() const {
    double sum = 0.5 * m * v * v + 0.5 * k * x * x;
    for (std::size_t j = 0; j < cells; ++j) sum += 0.5 * w[j] * w[j];
    for (const double e : strain) sum += 0.5 * e * e;
    return sum;
  }

  void grant_fluid(const Window& window, const InterfaceMotion& motion) override {
    const double before = copy;
    copy = motion.impulse.empty() ? (motion.position[0] - at_end) / window.dt : motion.velocity[0];
    at_end = motion.position[0];
    answer = {.load = {{0}, {0, 0}, {}}, .time_step_limit = dt, .health = {}};
    if (!motion.impulse.empty()) {
      const double dv = -motion.impulse[0];
      answer.load.work_of_impulse = dv * (w[0] + 0.5 * dv);
      answer.load.impulse_on_fluid[0] = dv;
      answer.load.impedance = {1, 0};
      w[0] += dv;
      rate[0] += before - copy;
    }
    const auto steps = std::lround(window.dt / dt);
    for (long n = 0; n < steps; ++n) step();
    answer.load.force[0] /= static_cast<double>(steps);
    answer.load.pressure[0] = -answer.load.force[0];
    answer.load.impulse_on_fluid[0] -= answer.load.force[0] * window.dt;
  }
  FluidAnswer await_fluid(const Window&) override { return answer; }

  void grant_solid(const Window& window, const InterfaceLoad& load) override {
    constexpr int steps = 400;
    const double h = window.dt / steps, z = load.velocity.empty() ? 0.0 : load.impedance[0];
    const double drive = load.force[0] + (z > 0 ? z * load.velocity[0] : 0.0);
    double impulse = 0;
    for (int n = 0; n < steps; ++n) {
      const double drift = (v + 0.5 * h * (drive - k * x) / m) / (1 + 0.5 * h * z / m);
      x += h * drift;
      v = drift + 0.5 * h * (drive - k * x - z * drift) / m;
      impulse += h * (drive - load.force[0] - z * drift);
    }
    moved = {
        {{x, 0}, {v, 0}}, Vec(window.dt * load.force[0] + impulse, 0), {.kinetic_energy = 0.5 * m * v * v}};
    if (z > 0) moved.motion.impulse = {impulse, 0};
  }
  SolidAnswer await_solid(const Window&) override { return moved; }

  std::vector<std::string> write_checkpoint(const Window&, const std::string&) override { return {}; }
  bool interrupted() const override { return false; }

  double m, k, dt;
  double x = 0, v = 0;            ///< of the mass
  std::array<double, cells> w{};  ///< velocities of the fluid
  double copy = 0, at_end = 0;    ///< velocity of its copy of the interface, and where that goes
  std::array<double, cells + 1> strain{}, rate{};
  FluidAnswer answer;
  SolidAnswer moved;

 private:
  double velocity(std::size_t side) const {  // of the near end, the cells, the far wall
    return side == 0 ? copy : side <= cells ? w[side - 1] : 0.0;
  }
  void find_rate() {
    for (std::size_t j = 0; j <= cells; ++j) rate[j] = velocity(j + 1) - velocity(j);
  }
  void step() {
    for (std::size_t j = 0; j <= cells; ++j) strain[j] += 0.5 * dt * rate[j];
    std::array<double, cells + 1> tension{};
    for (std::size_t j = 0; j <= cells; ++j)
      tension[j] = strain[j] + viscosity * (velocity(j + 1) - velocity(j));
    for (std::size_t j = 0; j < cells; ++j) w[j] += dt * (tension[j + 1] - tension[j]);
    answer.load.force[0] += tension[0];
    find_rate();
    for (std::size_t j = 0; j <= cells; ++j) strain[j] += 0.5 * dt * rate[j];
  }
};

}  // namespace toryu
