/// How what crosses the link goes into a checkpoint: see common/state/serialize.hpp.
#pragma once

#include "common/link/participant.hpp"

namespace toryu {

template <class Archive>
void serialize(Archive& archive, InterfaceMotion& motion) {
  auto& [position, velocity, impulse, work_of_impulse] = motion;
  archive(position, velocity, impulse, work_of_impulse);
}

template <class Archive>
void serialize(Archive& archive, InterfaceLoad& load) {
  auto& [pressure, force, friction_force, impulse_on_fluid, work_of_impulse, impedance, velocity] = load;
  archive(pressure, force, friction_force, impulse_on_fluid, work_of_impulse, impedance, velocity);
}

template <class Archive>
void serialize(Archive& archive, Window& window) {
  auto& [number, iteration, time, dt] = window;
  archive(number, iteration, time, dt);
}

}  // namespace toryu
