#include "common/link/wire.hpp"

#include <fmt/format.h>

#include <cmath>

namespace toryu::wire {

namespace {

/// Cyclone copies what a sequence points to and leaves it alone, though its type says otherwise.
dds_sequence_double sequence(const std::vector<double>& values) {
  const auto count = static_cast<std::uint32_t>(values.size());
  return {count, count, const_cast<double*>(values.data()), false};
}

std::vector<double> values(const dds_sequence_double& sequence) {
  return {sequence._buffer, sequence._buffer + sequence._length};
}

void check_values(const std::vector<double>& values, std::size_t particles, std::size_t components,
                  const char* name, const std::string& sender) {
  if (values.size() != particles * components)
    throw PeerLost(fmt::format("{}: {} values of {} came, {} were awaited", sender, values.size(), name,
                               particles * components));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw PhysicsFailure(
          fmt::format("{}: {} of interface particle {} is {}", sender, name, k / components, values[k]));
}

void check_above_zero(const std::vector<double>& values, std::size_t particles, const char* name,
                      const std::string& sender) {
  check_values(values, particles, 1, name, sender);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] <= 0)
      throw PeerLost(
          fmt::format("{}: {} of interface particle {} is {}, not above 0", sender, name, k, values[k]));
}

}  // namespace

void set(double (&components)[3], const Vec& value) {
  for (int c = 0; c < 3; ++c) components[c] = c < dim ? value[c] : 0.0;
}

Vec vector(const double (&components)[3]) {
  Vec value;
  for (int c = 0; c < dim; ++c) value[c] = components[c];
  return value;
}

toryu_WindowHead window(std::uint64_t session_id, const Window& window) {
  return {session_id, window.number, window.iteration, window.time, window.dt};
}

Window window(const toryu_WindowHead& message) {
  return {message.number, message.iteration, message.time, message.dt};
}

toryu_HealthReport health(const Health& health) {
  toryu_HealthReport message{health.kinetic_energy, health.potential_energy, {}, health.compute_time};
  set(message.momentum, health.momentum);
  return message;
}

Health health(const toryu_HealthReport& message) {
  return {message.kinetic_energy, message.potential_energy, vector(message.momentum), message.compute_time};
}

toryu_Interface interface_message(std::uint64_t session_id, const Interface& interface,
                                  const InterfaceMotion& start) {
  const auto count = static_cast<std::uint32_t>(interface.id.size());
  toryu_Interface message{};
  message.session_id = session_id;
  message.spacing = interface.spacing;
  message.id = {count, count, const_cast<std::uint32_t*>(interface.id.data()), false};
  message.reference_position = sequence(interface.position);
  message.volume = sequence(interface.volume);
  message.area_vector = sequence(interface.area_vector);
  message.mass = sequence(interface.mass);
  message.position = sequence(start.position);
  message.velocity = sequence(start.velocity);
  return message;
}

toryu_CheckpointRequest request_of_checkpoint(const toryu_WindowHead& window, const std::string& folder) {
  toryu_CheckpointRequest message{};
  message.window = window;
  message.folder = const_cast<char*>(folder.c_str());
  return message;
}

toryu_CheckpointReport report_of_checkpoint(const toryu_WindowHead& window, const std::string& failure) {
  toryu_CheckpointReport message{};
  message.window = window;
  message.failure = const_cast<char*>(failure.c_str());
  return message;
}

Interface interface_of(const toryu_Interface& message) {
  Interface interface;
  interface.id.assign(message.id._buffer, message.id._buffer + message.id._length);
  interface.position = values(message.reference_position);
  interface.volume = values(message.volume);
  interface.area_vector = values(message.area_vector);
  interface.mass = values(message.mass);
  interface.spacing = message.spacing;
  return interface;
}

InterfaceMotion start_of(const toryu_Interface& message) {
  return {values(message.position), values(message.velocity)};
}

toryu_Motion motion(const toryu_WindowHead& window, const InterfaceMotion& motion) {
  toryu_Motion message{};
  message.window = window;
  message.position = sequence(motion.position);
  message.velocity = sequence(motion.velocity);
  message.impulse = sequence(motion.impulse);
  message.work_of_impulse = motion.work_of_impulse;
  return message;
}

InterfaceMotion motion(const toryu_Motion& message) {
  return {values(message.position), values(message.velocity), values(message.impulse),
          message.work_of_impulse};
}

toryu_Load load(const toryu_WindowHead& window, const InterfaceLoad& load) {
  toryu_Load message{};
  message.window = window;
  message.pressure = sequence(load.pressure);
  message.force = sequence(load.force);
  message.friction_force = sequence(load.friction_force);
  set(message.impulse_on_fluid, load.impulse_on_fluid);
  message.work_of_impulse = load.work_of_impulse;
  message.impedance = sequence(load.impedance);
  message.velocity = sequence(load.velocity);
  return message;
}

InterfaceLoad load(const toryu_Load& message) {
  return {.pressure = values(message.pressure),
          .force = values(message.force),
          .friction_force = values(message.friction_force),
          .impulse_on_fluid = vector(message.impulse_on_fluid),
          .work_of_impulse = message.work_of_impulse,
          .impedance = values(message.impedance),
          .velocity = values(message.velocity)};
}

void check(const Interface& interface, const std::string& sender) {
  const std::size_t count = interface.size();
  check_values(interface.position, count, dim, "reference position", sender);
  check_above_zero(interface.volume, count, "volume", sender);
  check_values(interface.area_vector, count, dim, "area vector", sender);
  check_above_zero(interface.mass, count, "mass", sender);
  if (!(interface.spacing > 0) || !std::isfinite(interface.spacing))
    throw PeerLost(
        fmt::format("{}: spacing {} of the interface is not finite and above 0", sender, interface.spacing));
}

void check(const InterfaceMotion& motion, std::size_t particles, const std::string& sender) {
  check_values(motion.position, particles, dim, "position", sender);
  check_values(motion.velocity, particles, dim, "velocity", sender);
  if (!motion.impulse.empty()) check_values(motion.impulse, particles, dim, "impulse", sender);
  if (!std::isfinite(motion.work_of_impulse))
    throw PhysicsFailure(fmt::format("{}: work of the impulse is not finite", sender));
}

void check(const InterfaceLoad& load, std::size_t particles, const std::string& sender) {
  check_values(load.pressure, particles, 1, "pressure", sender);
  check_values(load.force, particles, dim, "force", sender);
  if (!load.friction_force.empty())
    check_values(load.friction_force, particles, dim, "friction force", sender);
  if (!load.velocity.empty()) check_values(load.velocity, particles, dim, "velocity", sender);
  if (!load.impedance.empty() || !load.velocity.empty())
    check_values(load.impedance, particles, dim, "impedance", sender);
  if (!load.impulse_on_fluid.allFinite())
    throw PhysicsFailure(fmt::format("{}: impulse on the fluid is not finite", sender));
  if (!std::isfinite(load.work_of_impulse))
    throw PhysicsFailure(fmt::format("{}: work of the impulse is not finite", sender));
}

void check(const Health& health, const std::string& sender) {
  const bool finite = std::isfinite(health.kinetic_energy) && std::isfinite(health.potential_energy) &&
                      health.momentum.allFinite() && std::isfinite(health.compute_time);
  if (!finite)
    throw PhysicsFailure(fmt::format("{}: an energy, the momentum or a time is not finite", sender));
}

void check(const toryu_WindowHead& window, const Window& expected, const std::string& sender) {
  if (window.number != expected.number || window.iteration != expected.iteration)
    throw PeerLost(fmt::format("{} sent window {} iteration {} where window {} iteration {} was awaited",
                               sender, window.number, window.iteration, expected.number, expected.iteration));
  if (!std::isfinite(window.time) || !(window.dt > 0) || !std::isfinite(window.dt))
    throw PhysicsFailure(
        fmt::format("{}: window {} at t = {} s is {} s long", sender, window.number, window.time, window.dt));
}

}  // namespace toryu::wire
