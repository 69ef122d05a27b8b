/// A plate in the place of the tank's right wall, as a solid would register it.
#pragma once

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {

/// Six columns of particles that stand in the place of the tank's right wall, finer than the fluid.
inline Interface plate() {
  Interface plate;
  plate.spacing = 0.025;
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 6; ++column) {
      plate.id.push_back(static_cast<std::uint32_t>(plate.id.size()));
      plate.position.push_back(0.5 + (column + 0.5) * plate.spacing);
      plate.position.push_back((row + 0.5) * plate.spacing);
      plate.volume.push_back(plate.spacing * plate.spacing);
      plate.area_vector.insert(plate.area_vector.end(), {column == 0 ? -plate.spacing : 0, 0});
    }
  return plate;
}

/// The plate moved by v t at time t.
inline InterfaceMotion moved(const Interface& plate, const Vec& v, double t) {
  InterfaceMotion motion{plate.position, {}};
  for (std::size_t k = 0; k < plate.size(); ++k) {
    motion.position[dim * k] += v[0] * t;
    motion.position[dim * k + 1] += v[1] * t;
    motion.velocity.insert(motion.velocity.end(), {v[0], v[1]});
  }
  return motion;
}

inline Setting tank_with_a_plate() {
  Setting setting = collapsing_column();
  setting.scene.walls.pop_back();
  setting.parameters.hydrostatic_start = HydrostaticStart{0.8};
  setting.parameters.laminar_viscosity = LaminarViscosity{3.0};
  return setting;
}

}  // namespace toryu::fluid
