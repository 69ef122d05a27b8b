#include "fluid_solver/flow_numbers.hpp"

#include <fmt/format.h>

#include "fluid_solver/passage_flow.hpp"

namespace toryu::fluid {

namespace {

struct Driven {
  double speed, width;  ///< [m/s], [m]
};

/// By gravity along the period, between the walls beside it.
std::optional<Driven> driven_by_gravity(const Parameters& p, const Scene& scene) {
  if (scene.periodic != Periodic::x && scene.periodic != Periodic::y) return {};
  const bool along_x = scene.periodic == Periodic::x, plane = scene.geometry == Geometry::plane;
  const double g = std::abs(scene.gravity[along_x ? 0 : 1]);
  if (g == 0) return {};
  const double side = sides(p.regions)[along_x ? 1 : 0], width = plane ? side : 2 * side;
  return Driven{mean_speed(p, p.density * g * width / (plane ? 2 : 4), width, scene.geometry), width};
}

std::optional<Driven> driven(const Parameters& p, const Scene& scene) {
  if (const double U = largest_wall_speed(scene); U > 0)
    return Driven{U, passage_width(p.regions, scene.geometry)};
  return driven_by_gravity(p, scene);
}

}  // namespace

std::optional<FlowNumbers> flow_numbers(const Parameters& p, const Scene& scene) {
  const auto flow = is_viscous(p) ? driven(p, scene) : std::nullopt;
  if (!flow) return {};
  const auto [U, w] = *flow;
  const PassageFlow passage = passage_flow(p, U, w, scene.geometry);
  FlowNumbers numbers{.speed = U,
                      .width = w,
                      .reynolds = p.density * U * w / passage.wall_viscosity,
                      .mach = U / p.sound_speed};
  if (p.viscoelasticity)
    for (const PolymerMode& mode : p.viscoelasticity->modes)
      numbers.weissenberg.push_back(mode.relaxation_time * passage.wall_shear_rate);
  return numbers;
}

std::string text(const FlowNumbers& numbers) {
  std::string said = fmt::format("Re {:.2g}, Ma {:.2g}", numbers.reynolds, numbers.mach);
  for (std::size_t k = 0; k < numbers.weissenberg.size(); ++k)
    said += fmt::format("{}{:.2g}", k == 0 ? ", Wi " : " and ", numbers.weissenberg[k]);
  return said + fmt::format(" at {:.3g} m/s over the fluid's {:g} m", numbers.speed, numbers.width);
}

}  // namespace toryu::fluid
