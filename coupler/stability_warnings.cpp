#include "coupler/stability_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "coupler/added_mass.hpp"

namespace toryu::coupling {

namespace {

/// Fluid steps per window up to which the elastic gate's motion agrees with that at 1: at 2 within 1 %, at 4
/// its peak is 6 % too far (cases/elastic_gate/terms.toml).
constexpr int largest_calm_window = 2;

constexpr double usual_smoothing_ratio = 1.3;  // where the case does not say it
// Limits of the fluid's step, over h/c_0 and over h^2 and the kinematic viscosity; those of acceleration and
// friction show only in the flow.
constexpr double acoustic_share = 0.25, viscous_share = 0.125;

/// Thickness of the thinnest region [m]; infinite without one.
double thickness(const CaseFile& file) {
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0;; ++n) {
    const auto side = [&](int axis) -> std::optional<double> {
      const auto low = file.value<double>(fmt::format("solid.region[{}].box.min[{}]", n, axis));
      const auto high = file.value<double>(fmt::format("solid.region[{}].box.max[{}]", n, axis));
      if (!low || !high) return std::nullopt;
      return *high - *low;
    };
    for (int axis = 0; axis < dim; ++axis) {
      const auto length = side(axis);
      if (!length) return least;
      least = std::min(least, *length);
    }
  }
}

/// Viscosity of the medium at rest [Pa s], 0 if the case gives none; nothing where only the fluid knows it.
std::optional<double> viscosity_at_rest(const CaseFile& file) {
  for (const char* section : {"fluid.medium", "fluid.temperature", "fluid.viscoelasticity"})
    if (file.has(section)) return std::nullopt;
  const bool thickens = file.value<double>("fluid.power_law.exponent").value_or(0.0) > 1;
  for (const char* key :
       {"fluid.laminar_viscosity.dynamic_viscosity", "fluid.carreau.zero_shear_viscosity",
        thickens ? "fluid.power_law.smallest_viscosity" : "fluid.power_law.largest_viscosity",
        "fluid.herschel_bulkley.largest_viscosity"})
    if (const auto viscosity = file.value<double>(key)) return *viscosity;
  return 0;
}

/// Length of a window of the fluid at rest [s]; 0 where the case does not tell it, and the run alone will.
double foreseen_window(const CaseFile& file, const FluidTraits& fluid, int steps) {
  const auto viscosity = viscosity_at_rest(file);
  if (!viscosity) return 0;
  const double h = 0.5 * fluid.reach, nu = *viscosity / fluid.density;
  double limit = acoustic_share * h / fluid.sound_speed;
  if (nu > 0) limit = std::min(limit, viscous_share * h * h / nu);
  return steps * file.value<double>("fluid.time_step_share").value_or(1.0) * limit;
}

}  // namespace

std::vector<std::string> stability_warnings(const CaseFile& file, const Parameters& coupling) {
  std::vector<std::string> said;
  const bool lags =
      coupling.scheme == SchemeKind::serial_explicit || coupling.scheme == SchemeKind::parallel_explicit;
  if (lags && coupling.fluid_steps_per_window > largest_calm_window)
    said.push_back(fmt::format(
        "fluid_steps_per_window = {}: above {} the force on the interface may ring and the motion be wrong "
        "without a failure; compare with 1, see cases/pushed_column/window_map.toml",
        coupling.fluid_steps_per_window, largest_calm_window));
  const SolidKind solid = solid_kind(file);
  const bool rigid = solid != SolidKind::elastic;
  if (lags && !rigid && !file.has("solid.artificial_viscosity") && !file.has("solid.damping"))
    said.emplace_back(
        "nothing damps the solid: the lag of a window feeds modes that turn by a quarter cycle and more in "
        "it; take scheme = 'serial_robin', or give it [solid.artificial_viscosity]");
  const auto number = [&](const char* key) { return file.value<double>(key).value_or(0.0); };
  FluidTraits fluid{.density = number("fluid.density"),
                    .sound_speed = number("fluid.sound_speed"),
                    .spacing = number("fluid.spacing")};
  if (!(fluid.density > 0 && fluid.sound_speed > 0 && fluid.spacing > 0)) return said;
  fluid.reach =
      2 * file.value<double>("fluid.smoothing_ratio").value_or(usual_smoothing_ratio) * fluid.spacing;
  // No deeper than the kernel sees, but for a rigid body, which moves as a whole.
  const double depth = rigid ? thickness(file) : std::min(thickness(file), layer_depth(fluid));
  double density = number("solid.density");
  for (int k = 0; const auto lighter = file.value<double>(fmt::format("solid.material[{}].density", k)); ++k)
    density = std::min(density, *lighter);
  const double ratio = density * depth / (fluid.density * fluid.spacing);
  const double least = least_mass_ratio(coupling.scheme, solid, fluid,
                                        foreseen_window(file, fluid, coupling.fluid_steps_per_window));
  if (ratio > 0 && ratio < least) said.push_back(too_light(ratio, least));
  return said;
}

}  // namespace toryu::coupling
