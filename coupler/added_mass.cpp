#include "coupler/added_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/sph/sorted_points.hpp"

namespace toryu::coupling {

namespace {

/// A face is wet if the force on its particle points into it (out of it under suction) within 60 degrees: a
/// fluid behind the solid, whose kernel sees through it, pulls at the dry face instead.
constexpr double least_cosine = 0.5;

/// Where a row lies at the reach itself, rounding must not choose among its particles.
constexpr double hair = 1e-9;

/// Reach of the kernel, over the spacing, with which the lower bounds were measured.
constexpr double measured_reach = 2.5;

Eigen::Map<const Vec> item(const std::vector<double>& vectors, std::size_t k) {
  return Eigen::Map<const Vec>(&vectors[dim * k]);
}

}  // namespace

double layer_depth(const FluidTraits& fluid) {
  return fluid.reach - 0.5 * fluid.spacing;
}

SurfaceLayer::SurfaceLayer(const Interface& interface, const FluidTraits& fluid)
    : mass_(interface.mass), row_(fluid.density * fluid.spacing) {
  std::vector<Vec> places(interface.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = item(interface.position, k);
  const double half = 0.5 * interface.spacing;
  const double deepest = (1 + hair) * layer_depth(fluid), reach = std::max(deepest, interface.spacing);
  const SortedPoints points(places, reach);
  for (std::uint32_t k = 0; k < places.size(); ++k) {
    const Vec area = item(interface.area_vector, k);
    if (area.isZero(0)) continue;
    Face& face = faces_.emplace_back(Face{k, area, {k}});
    const Vec inward = -area.normalized();
    points.near(places[k], reach, [&](std::uint32_t j) {
      const Vec from = places[j] - places[k];
      const double depth = from.dot(inward), aside = (from - depth * inward).norm();
      if (j != k && depth > 0 && depth + half < deepest && aside < (1 + hair) * half)
        face.behind.push_back(j);
    });
  }
}

std::optional<double> SurfaceLayer::mass_ratio(const InterfaceLoad& load) const {
  std::vector<char> weighed(mass_.size());
  double mass = 0, area = 0;
  for (const Face& face : faces_) {
    const Vec force = item(load.force, face.particle);
    const double inward = load.pressure[face.particle] < 0 ? force.dot(face.area) : -force.dot(face.area);
    if (!(inward > least_cosine * force.norm() * face.area.norm())) continue;
    area += face.area.norm();
    for (const std::uint32_t j : face.behind)
      if (!std::exchange(weighed[j], 1)) mass += mass_[j];
  }
  if (!(area > 0 && row_ > 0)) return std::nullopt;
  return mass / area / row_;
}

SolidKind solid_kind(const CaseFile& file) {
  if (file.value<std::string>("solid.formulation") != "rigid") return SolidKind::elastic;
  const auto is_held = [&](const std::string& mounting) {
    int fixed = 0;  // of x, y and the angle, each named once
    while (file.value<std::string>(fmt::format("{}.fixed[{}]", mounting, fixed))) ++fixed;
    return fixed == dim + 1;
  };
  int bodies = 0, held = 0;
  for (; file.value<std::string>(fmt::format("solid.body[{}].name", bodies)); ++bodies)
    held += is_held(fmt::format("solid.body[{}].mounting", bodies)) ? 1 : 0;
  const bool all = bodies > 0 ? held == bodies : is_held("solid.mounting");
  return all ? SolidKind::held : SolidKind::rigid;
}

double least_mass_ratio(SchemeKind scheme, SolidKind solid, const FluidTraits& fluid, double dt) {
  if (solid == SolidKind::held || (solid == SolidKind::rigid && scheme == SchemeKind::serial_robin)) return 0;
  const double courant = fluid.spacing > 0 ? fluid.sound_speed * dt / fluid.spacing : 0.0;
  const double width =
      fluid.spacing > 0 ? std::max(1.0, fluid.reach / (measured_reach * fluid.spacing)) : 1.0;
  switch (scheme) {
    case SchemeKind::serial_robin:
      return 0.03 * width;
    case SchemeKind::serial_explicit:
      return std::max(0.37 * width, 0.25 * courant * courant);
    case SchemeKind::parallel_explicit:
      return std::max(0.9 * width, 0.25 * courant * courant);
    default:
      return 0.0;
  }
}

std::string too_light(double ratio, double least) {
  return fmt::format(
      "the solid's surface layer weighs {:.3g} of a row of fluid, the scheme bears {:.3g}: beyond the edge "
      "of stability; take scheme = 'serial_robin' or 'serial_implicit', or shorter windows, see "
      "cases/pushed_column/added_mass_map.toml",
      ratio, least);
}

}  // namespace toryu::coupling
