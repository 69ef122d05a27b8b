#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/implicit/implicit.hpp"
#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"

namespace toryu::fluid {

std::unique_ptr<FluidModel> make_model(const Parameters& parameters, const Scene& scene) {
  if (parameters.model == Model::implicit) return std::make_unique<Implicit>(parameters, scene);
  return std::make_unique<WeaklyCompressible>(parameters, scene);
}

}  // namespace toryu::fluid
