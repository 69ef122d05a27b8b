#include "solid_solver/run_coupled.hpp"

#include <spdlog/spdlog.h>

#include "common/run/program.hpp"

namespace toryu {

void run_coupled(SolidLink& link, SolidRun& run) {
  SolidModel& model = run.model();
  const double reach = link.join();
  const Interface interface = model.interface(reach);
  spdlog::info("solid: {} particles can be touched by a fluid that sees {:g} m deep", interface.size(),
               reach);
  link.register_interface(interface, model.motion(interface.id));
  run.at(0);
  while (const auto turn = link.next_window()) {
    throw_if_interrupted();
    const Vec force = model.set_interface_load(interface.id, turn->load);
    const SubSteps steps = run.advance(turn->dt);
    Vec impulse_taken = Vec::Zero();
    for (long n = 0; n < steps.taken; ++n) impulse_taken += steps.dt * force;
    link.count_step();
    run.at(turn->time + turn->dt);
    link.send(model.motion(interface.id), impulse_taken, model.health());
  }
}

}  // namespace toryu
