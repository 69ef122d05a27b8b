#include "fluid_solver/processes.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <csignal>

#include "fluid_solver/ranks/orders.hpp"
#include "fluid_solver/ranks/rank_faults.hpp"
#include "fluid_solver/ranks/spread_fluid.hpp"

namespace toryu::fluid {

namespace {

bool is_alone() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size == 1;
}

}  // namespace

int over_processes(int argc, char** argv, const std::function<int()>& lead,
                   const std::function<std::pair<Parameters, Scene>()>& read) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int rank = 0, code = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    code = lead();
    give(MPI_COMM_WORLD, {.action = Action::end});
  } else {
    std::signal(SIGUSR1, SIG_IGN);  // by which mpirun passes on to all what is for the lead
    end_all_if_it_fails(MPI_COMM_WORLD, [&] { follow(MPI_COMM_WORLD, read); });
  }
  MPI_Finalize();
  return code;
}

std::vector<StartFault> process_faults(const Parameters& parameters, const Scene& scene) {
  return is_alone() ? std::vector<StartFault>{} : rank_faults(parameters, scene);
}

std::unique_ptr<FluidModel> make_spread_model(const Parameters& parameters, const Scene& scene) {
  if (is_alone()) return make_model(parameters, scene);
  return std::make_unique<SpreadFluid>(parameters, scene, MPI_COMM_WORLD);
}

}  // namespace toryu::fluid
