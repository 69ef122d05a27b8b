#include "fluid_solver/processes.hpp"

namespace toryu::fluid {

int over_processes(int /*argc*/, char** /*argv*/, const std::function<int()>& lead,
                   const std::function<std::pair<Parameters, Scene>()>& /*read*/) {
  return lead();
}

std::vector<StartFault> process_faults(const Parameters& /*parameters*/, const Scene& /*scene*/) {
  return {};
}

std::unique_ptr<FluidModel> make_spread_model(const Parameters& parameters, const Scene& scene) {
  return make_model(parameters, scene);
}

}  // namespace toryu::fluid
