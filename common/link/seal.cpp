#include "common/link/seal.hpp"

#define XXH_STATIC_LINKING_ONLY  // for a state on the stack
#include <xxhash.h>

#include <cstring>
#include <type_traits>

namespace toryu::dds {

namespace {

class Sum {
 public:
  explicit Sum(std::uint64_t secret) {
    XXH3_INITSTATE(&state_);  // else a state that the stack held of the same secret counts as prepared
    XXH3_64bits_reset_withSeed(&state_, secret);
  }
  std::uint64_t digest() const { return XXH3_64bits_digest(&state_); }

  template <class Value>
  void add(const Value& value) {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>, "a struct may have gaps");
    add(&value, sizeof value);
  }
  template <std::size_t count>
  void add(const double (&values)[count]) {
    add(values, sizeof values);
  }
  void add(char* text) {
    const std::size_t length = text ? std::strlen(text) : 0;
    add(length);
    add(text, length);
  }
  void add(const dds_sequence_double& values) { add_sequence(values); }
  void add(const dds_sequence_unsigned_long& values) { add_sequence(values); }
  void add(const toryu_WindowHead& window) {
    const auto& [session_id, number, iteration, time, dt] = window;
    add_all(session_id, number, iteration, time, dt);
  }
  void add(const toryu_HealthReport& health) {
    const auto& [kinetic_energy, potential_energy, momentum, compute_time] = health;
    add_all(kinetic_energy, potential_energy, momentum, compute_time);
  }
  template <class... Values>
  void add_all(const Values&... values) {
    (add(values), ...);
  }

 private:
  void add(const void* bytes, std::size_t count) {
    if (count > 0) XXH3_64bits_update(&state_, bytes, count);
  }
  template <class Sequence>
  void add_sequence(const Sequence& values) {
    add(values._length);
    add(values._buffer, values._length * sizeof *values._buffer);
  }

  XXH3_state_t state_;
};

template <class... Values>
std::uint64_t sum_of(std::uint64_t secret, const Values&... values) {
  Sum sum(secret);
  sum.add_all(values...);
  return sum.digest();
}

}  // namespace

// The bindings name every field, so that one that is added to a message and forgotten here does not compile.

std::uint64_t seal_of(const toryu_Hello& message, std::uint64_t secret) {
  const auto& [sender, session_id, role, program, version, process, protocol, case_hash, units, dimension,
               reach, time_step_limit, density, sound_speed, spacing, can_repeat, can_checkpoint, used_case,
               seal] = message;
  return sum_of(secret, sender, session_id, role, program, version, process, protocol, case_hash, units,
                dimension, reach, time_step_limit, density, sound_speed, spacing, can_repeat, can_checkpoint,
                used_case);
}

std::uint64_t seal_of(const toryu_Session& message, std::uint64_t secret) {
  const auto& [sender, session_id, phase, heartbeat, process, fluid, solid, reach, time_limit, windows_repeat,
               checkpoints, restart, exit_code, reason, seal] = message;
  return sum_of(secret, sender, session_id, phase, heartbeat, process, fluid, solid, reach, time_limit,
                windows_repeat, checkpoints, restart, exit_code, reason);
}

std::uint64_t seal_of(const toryu_Status& message, std::uint64_t secret) {
  const auto& [sender, session_id, window, steps, interrupted, activity, exit_code, reason, seal] = message;
  return sum_of(secret, sender, session_id, window, steps, interrupted, activity, exit_code, reason);
}

std::uint64_t seal_of(const toryu_Interface& message, std::uint64_t secret) {
  const auto& [sender, session_id, spacing, id, reference_position, volume, area_vector, mass, position,
               velocity, seal] = message;
  return sum_of(secret, sender, session_id, spacing, id, reference_position, volume, area_vector, mass,
                position, velocity);
}

std::uint64_t seal_of(const toryu_Motion& message, std::uint64_t secret) {
  const auto& [sender, window, position, velocity, impulse, work_of_impulse, impulse_taken, health, seal] =
      message;
  return sum_of(secret, sender, window, position, velocity, impulse, work_of_impulse, impulse_taken, health);
}

std::uint64_t seal_of(const toryu_Load& message, std::uint64_t secret) {
  const auto& [sender, window, pressure, force, friction_force, impedance, velocity, impulse_on_fluid,
               work_of_impulse, time_step_limit, health, seal] = message;
  return sum_of(secret, sender, window, pressure, force, friction_force, impedance, velocity,
                impulse_on_fluid, work_of_impulse, time_step_limit, health);
}

std::uint64_t seal_of(const toryu_CheckpointRequest& message, std::uint64_t secret) {
  const auto& [sender, window, folder, seal] = message;
  return sum_of(secret, sender, window, folder);
}

std::uint64_t seal_of(const toryu_CheckpointReport& message, std::uint64_t secret) {
  const auto& [sender, window, failure, seal] = message;
  return sum_of(secret, sender, window, failure);
}

}  // namespace toryu::dds
