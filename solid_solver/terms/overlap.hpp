/// What contact at walls and between bodies share: how much of a kernel a half plane of particles fills, by
/// which they measure depth, and how hard they push.
#pragma once

#include <cmath>

#include "common/case/parameter_table.hpp"
#include "common/sph/kernel.hpp"
#include "common/vector.hpp"
#include "solid_solver/material.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the sums are over a half plane");

struct Contact {
  double stiffness = 1.0;  ///< contact pressure where the overlap has doubled, over the bulk modulus
  double modulus = 0;      ///< in the place of the bulk modulus [Pa]; 0: that of the solid
  /// Contact pressure where the overlap has doubled [Pa].
  double pressure_scale(const ElasticMaterial& material) const {
    return stiffness * (modulus > 0 ? modulus : material.bulk_modulus());
  }
};
inline void describe(ParameterTable& table, Contact& p) {
  table.number("stiffness", p.stiffness,
               {.minimum = 0,
                .maximum = 10,
                .above_minimum = true,
                .help = "contact pressure where the overlap has doubled, over the bulk modulus"});
  if (table.wants(p.modulus > 0))
    table.number(
        "modulus", p.modulus,
        {.unit = "Pa", .minimum = 0, .help = "in the place of the bulk modulus; a rigid body needs it"});
}

/// Sum of V W over a half plane of particles whose uppermost row is `distance` [m] below, and the largest
/// slope of it [1/m].
struct HalfPlane {
  double sum = 0, slope = 0;
};
inline HalfPlane half_plane(const CubicSpline& W, double spacing, double distance) {
  const double V = spacing * spacing;
  HalfPlane found;
  for (double y = distance; y < W.support(); y += spacing)
    for (double x = -std::ceil(W.support() / spacing) * spacing; x <= W.support(); x += spacing) {
      const double r = std::hypot(x, y);
      found.sum += V * W.value(r);
      found.slope -= V * W.gradient_over_r(r, 1.0 / r) * y;
    }
  return found;
}

}  // namespace toryu::solid
