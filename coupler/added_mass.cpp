#include "coupler/added_mass.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace toryu {

namespace {

/// A face is wet if the force on its particle points into it (out of it under suction) within 60 degrees: a
/// fluid behind the solid, whose kernel sees through it, pulls at the dry face instead.
constexpr double least_cosine = 0.5;

/// Reach of the kernel, over the spacing, with which the lower bounds were measured.
constexpr double measured_reach = 2.5;

Eigen::Map<const Vec> item(const std::vector<double>& vectors, std::size_t k) {
  return Eigen::Map<const Vec>(&vectors[dim * k]);
}

}  // namespace

std::optional<double> layer_mass_ratio(const Interface& interface, const InterfaceLoad& load,
                                       const FluidTraits& fluid) {
  double mass = 0, area = 0;
  for (std::size_t k = 0; k < interface.size(); ++k) {
    const Vec force = item(load.force, k), face = item(interface.area_vector, k);
    if (force.isZero(0)) continue;
    mass += interface.mass[k];
    const double inward = load.pressure[k] < 0 ? force.dot(face) : -force.dot(face);
    if (inward > least_cosine * force.norm() * face.norm()) area += face.norm();
  }
  const double row = fluid.density * fluid.spacing;
  if (!(area > 0 && row > 0)) return std::nullopt;
  return mass / area / row;
}

double least_mass_ratio(CouplingScheme scheme, const FluidTraits& fluid, double dt) {
  const double courant = fluid.spacing > 0 ? fluid.sound_speed * dt / fluid.spacing : 0.0;
  const double width =
      fluid.spacing > 0 ? std::max(1.0, fluid.reach / (measured_reach * fluid.spacing)) : 1.0;
  switch (scheme) {
    case CouplingScheme::serial_explicit:
      return std::max(0.37 * width, 0.25 * courant * courant);
    case CouplingScheme::parallel_explicit:
      return std::max(0.9 * width, 0.25 * courant * courant);
    default:
      return 0.0;
  }
}

std::string too_light(double ratio, double least) {
  return fmt::format(
      "the solid's surface layer weighs {:.3g} of a row of fluid, the scheme bears {:.3g}: beyond the edge "
      "of stability; take scheme = 'serial_implicit' or shorter windows, see "
      "cases/pushed_column/added_mass_map.toml",
      ratio, least);
}

}  // namespace toryu
