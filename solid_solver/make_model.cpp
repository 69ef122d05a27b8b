#include "solid_solver/make_model.hpp"

#include "solid_solver/mixed_solid.hpp"
#include "solid_solver/rigid/rigid_body.hpp"
#include "solid_solver/total_lagrangian/total_lagrangian.hpp"
#include "solid_solver/updated_lagrangian/updated_lagrangian.hpp"

namespace toryu::solid {

std::unique_ptr<SolidModel> make_model(const Parameters& parameters, const Body& body, const Scene& scene) {
  switch (parameters.formulation) {
    case Formulation::total_lagrangian:
      return std::make_unique<TotalLagrangian>(parameters, body, scene);
    case Formulation::updated_lagrangian:
      return std::make_unique<UpdatedLagrangian>(parameters, body, scene);
    default:
      return std::make_unique<RigidBody>(parameters, body, scene);
  }
}

std::unique_ptr<Solid> make_solid(const std::vector<Part>& parts, const Scene& scene) {
  auto model = make_model(parts[0].parameters, parts[0].body, scene);
  if (parts.size() == 1) return model;
  return std::make_unique<MixedSolid>(std::move(model),
                                      make_model(parts[1].parameters, parts[1].body, scene));
}

}  // namespace toryu::solid
