#include "solid_solver/make_model.hpp"

#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

namespace toryu {

std::unique_ptr<SolidModel> make_model(const SolidParameters& parameters, const SolidBody& body,
                                       const Scene& scene) {
  return std::make_unique<TotalLagrangian>(parameters, body, scene);
}

}  // namespace toryu
