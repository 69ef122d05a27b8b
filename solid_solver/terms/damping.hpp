/// Damping in proportion to the velocity, dv/dt = -rate v, to find the state of rest under a load (dynamic
/// relaxation, Otter 1965). Twice the lowest angular frequency of the body is fastest.
#pragma once

#include <cmath>

#include "common/case/parameter_table.hpp"

namespace toryu::solid {

struct Damping {
  double rate = 0;  ///< [1/s]
  /// What is left of a velocity after `time` [s].
  double factor(double time) const { return std::exp(-rate * time); }
};
inline void describe(ParameterTable& table, Damping& p) {
  table.number(
      "rate", p.rate,
      {.unit = "1/s", .minimum = 0, .required = true, .help = "share of the velocity lost in a second"});
}

}  // namespace toryu::solid
