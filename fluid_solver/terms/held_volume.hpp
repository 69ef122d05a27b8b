/// What a case says of a volume that is held; held_volume.hpp has the formula.
#pragma once

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// The volume of a medium that walls enclose stays what it was, see held_volume.hpp.
struct HeldVolume {
  static constexpr const char* section = "held_volume";
  static constexpr const char* help = "walls that enclose the medium leave it the volume that it starts with";
};
inline void describe(ParameterTable&, HeldVolume&) {}

inline ActiveTerm text(const HeldVolume&, const Medium&) {
  return {"held volume", "rho_i <- rho_i sum_j V_j/(sum_j V_j at the start) after each step", "", ""};
}

}  // namespace toryu::fluid
