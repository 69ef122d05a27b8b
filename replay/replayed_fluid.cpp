/// A fluid that answers with what another run recorded, so that a solid can be validated alone. Usage as
/// fluid_solver, with `--record RESULTS`.
#include "replay/replayed_side.hpp"

using namespace toryu;

int main(int argc, char** argv) {
  const auto join = [](FluidLink& link, const replay::Recording& recording) {
    recording.check(link.join(recording.start().traits));
  };
  const auto answer = [](FluidLink& link, replay::Recording& recording, const FluidLink::Turn& turn) {
    const FluidAnswer recorded = recording.fluid_over(turn, turn.motion.impulse);
    link.send(recorded.load, recorded.time_step_limit, recorded.health);
  };
  // Iterations would answer a load that does not answer them.
  return replay::run_side<FluidLink>("fluid", false, argc, argv, join, answer);
}
