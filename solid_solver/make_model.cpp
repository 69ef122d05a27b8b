#include "solid_solver/make_model.hpp"

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

}  // namespace toryu::solid
