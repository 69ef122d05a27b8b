#include "solid_solver/make_model.hpp"

#include "solid_solver/total_lagrangian/total_lagrangian.hpp"
#include "solid_solver/updated_lagrangian/updated_lagrangian.hpp"

namespace toryu::solid {

std::unique_ptr<SolidModel> make_model(const Parameters& parameters, const Body& body, const Scene& scene) {
  if (parameters.formulation == Formulation::total_lagrangian)
    return std::make_unique<TotalLagrangian>(parameters, body, scene);
  return std::make_unique<UpdatedLagrangian>(parameters, body, scene);
}

}  // namespace toryu::solid
