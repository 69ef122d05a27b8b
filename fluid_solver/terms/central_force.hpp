/// A pull towards a point (Monaghan & Rafiee 2013): it holds a drop together.
#pragma once

#include <fmt/format.h>

#include <optional>

#include "common/case/parameter_table.hpp"
#include "common/vector.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// Pulls all of the fluid towards a point, as strong as it is far: acceleration rate^2 times distance.
struct CentralForce {
  static constexpr const char* section = "central_force";
  static constexpr const char* help = "pulls the fluid towards a point";
  double rate = 0;  ///< Omega [1/s]
  Vec centre = Vec::Zero();
};
inline void describe(ParameterTable& table, CentralForce& force) {
  table.number(
      "rate", force.rate,
      {.unit = "1/s", .minimum = 0, .required = true, .help = "acceleration is rate^2 times distance"});
  table.vector("centre", force.centre, {.unit = "m", .help = "towards which it pulls"});
}

inline ActiveTerm text(const CentralForce& force, const Medium&) {
  return {"central force", "-Omega^2 (x - x_c)", "Monaghan & Rafiee 2013",
          fmt::format("Omega {} 1/s", force.rate)};
}

}  // namespace toryu::fluid
