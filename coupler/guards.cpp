#include "coupler/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "coupler/added_mass.hpp"

namespace toryu {

namespace {

/// Fluid steps per window up to which the elastic gate's motion agrees with that at 1: at 2 within 1 %, at 4
/// its peak is 6 % too far (cases/elastic_gate/terms.toml).
constexpr int largest_calm_window = 2;

constexpr double usual_smoothing_ratio = 1.3;  // where the case does not say it
constexpr double usual_courant_number = 0.25;  // step of the fluid over h/c_0

/// Thickness of the thinnest region [m]; infinite without one.
double thickness(const CaseFile& file) {
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0;; ++n) {
    const auto side = [&](int axis) -> std::optional<double> {
      const auto low = file.number(fmt::format("solid.region[{}].box.min[{}]", n, axis));
      const auto high = file.number(fmt::format("solid.region[{}].box.max[{}]", n, axis));
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

}  // namespace

std::vector<std::string> beyond_edges(const CaseFile& file, const CouplingParameters& coupling) {
  std::vector<std::string> said;
  if (coupling.fluid_steps_per_window > largest_calm_window)
    said.push_back(fmt::format(
        "fluid_steps_per_window = {}: above {} the force on the interface may ring and the motion be wrong "
        "without a failure; compare with 1, see cases/pushed_column/window_map.toml",
        coupling.fluid_steps_per_window, largest_calm_window));
  const auto number = [&](const char* key) { return file.number(key).value_or(0.0); };
  FluidTraits fluid{.density = number("fluid.density"),
                    .sound_speed = number("fluid.sound_speed"),
                    .spacing = number("fluid.spacing")};
  if (!(fluid.density > 0 && fluid.sound_speed > 0 && fluid.spacing > 0)) return said;
  const double h = file.number("fluid.smoothing_ratio").value_or(usual_smoothing_ratio) * fluid.spacing;
  fluid.reach = 2 * h;
  const double depth = std::min(thickness(file), layer_depth(fluid));  // no deeper than the kernel sees
  const double ratio = number("solid.density") * depth / (fluid.density * fluid.spacing);
  const double least = least_mass_ratio(
      coupling.scheme, fluid, coupling.fluid_steps_per_window * usual_courant_number * h / fluid.sound_speed);
  if (ratio > 0 && ratio < least) said.push_back(too_light(ratio, least));
  return said;
}

}  // namespace toryu
