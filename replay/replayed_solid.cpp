/// A solid that moves as another run recorded, so that a fluid can be validated alone. Usage as solid_solver,
/// with `--record RESULTS`.
#include "replay/replayed_side.hpp"

using namespace toryu;

int main(int argc, char** argv) {
  const auto join = [](SolidLink& link, const replay::Recording& recording) {
    recording.check_reach(link.join());
    link.register_interface(recording.start().interface, recording.start().motion);
  };
  const auto answer = [](SolidLink& link, replay::Recording& recording, const SolidLink::Turn& turn) {
    const SolidAnswer recorded = recording.solid_over(turn, turn.load);
    link.send(recorded.motion, recorded.impulse_taken, recorded.health);
  };
  return replay::run_side<SolidLink>("solid", true, argc, argv, join, answer);
}
