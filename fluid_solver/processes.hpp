/// Over how many processes a program computes its fluid: over one (one_process.cpp), or in a build with MPI
/// over as many as mpirun starts (ranks/processes.cpp).
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/start_checks.hpp"

namespace toryu::fluid {

/// Calls `lead` in the process that leads the run, and returns what that returns. The others hold parts of
/// the fluid for it; they find its case by `read`.
int over_processes(int argc, char** argv, const std::function<int()>& lead,
                   const std::function<std::pair<Parameters, Scene>()>& read);

/// What of the case cannot be computed by so many processes.
std::vector<StartFault> process_faults(const Parameters& parameters, const Scene& scene);

/// The model of the case, whose fluid is spread over all processes.
std::unique_ptr<FluidModel> make_spread_model(const Parameters& parameters, const Scene& scene);

}  // namespace toryu::fluid
