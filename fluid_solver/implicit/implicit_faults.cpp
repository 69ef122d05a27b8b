#include "fluid_solver/implicit/implicit_faults.hpp"

#include <fmt/format.h>

namespace toryu::fluid {

namespace {

constexpr const char* key_of_model = "fluid.model";

/// Terms that are in the matrix, or act between steps.
template <class Term>
constexpr bool is_implicit =
    is_one_of<Term, BackgroundPressure, EnclosedMedium, ParticleShifting, LaminarViscosity, PowerLaw,
              HerschelBulkley, Carreau, SlipLaw, Friction, Removal>;

}  // namespace

std::vector<StartFault> implicit_faults(const Parameters& p, const Scene& scene, bool with_solid) {
  if (p.model != Model::implicit) return {};
  std::vector<StartFault> faults;
  const auto refuse = [&](const std::string& key, const std::string& why) {
    faults.push_back({key, why + " model = \"implicit\""});
  };
  for_each_term(p, [&]<class Term>(const std::optional<Term>& term) {
    if (term && !is_implicit<Term>)
      refuse(std::string("fluid.") + Term::section,
             std::string("[fluid.") + Term::section + "] is not part of");
  });
  for (const Wall& wall : scene.walls)
    if (wall.press && !(p.implicit && p.implicit->expected_speed > 0))
      refuse("fluid.implicit.expected_speed",
             fmt::format("the wall '{}' is pressed, and the first steps must know how fast the medium will "
                         "be: give the 'expected_speed' that is needed by",
                         wall.name));
  for (std::size_t i = 0; i < scene.walls.size(); ++i)
    if (scene.walls[i].motion && scene.walls[i].motion->turns())
      refuse(fmt::format("wall.{}.box", i),
             fmt::format("the wall '{}' turns, which is not part of", scene.walls[i].name));
  if (scene.gravity_change) refuse("case.gravity_change", "gravity that changes is not part of");
  if (with_solid) refuse(key_of_model, "an elastic solid is not coupled to");
  if (!is_viscous(p))
    refuse(key_of_model, "a viscosity ([fluid.laminar_viscosity], a law of shear) is needed by");
  if (p.friction && !p.wall_slip)  // its force is not in the matrix; beside a slip it is a limit of that
    refuse("fluid.friction", "[fluid.friction] without [fluid.wall_slip] is not part of");
  if (p.similarity)
    refuse("fluid.similarity", "its steps do not depend on the density, so nothing is chosen for");
  if (!p.wall_model.suction)
    refuse("fluid.wall_model.suction", "walls that do not hold the fluid are not part of");
  if (p.wall_model.density == WallDensity::from_pressure)
    refuse("fluid.wall_model.density", "walls of another density than at rest are not part of");
  return faults;
}

StartFault implicit_surface_fault() {
  return {"fluid.model",
          "the fluid has a free surface at the start, and model = \"implicit\" is for media that walls or "
          "periods enclose"};
}

}  // namespace toryu::fluid
