#include "coupler/prediction.hpp"

namespace toryu::coupling {

Prediction::Prediction(const InterfaceMotion& at_start, double response_time)
    : response_time_(response_time), state_{.now = at_start} {
  state_.now.impulse.assign(at_start.velocity.size(), 0.0);
  state_.acceleration.assign(at_start.velocity.size(), 0.0);
}

InterfaceMotion Prediction::over(double dt) const {
  InterfaceMotion motion = state_.now;
  for (std::size_t k = 0; k < motion.position.size(); ++k) {
    motion.velocity[k] += 0.5 * dt * state_.acceleration[k];
    motion.position[k] += dt * motion.velocity[k];
  }
  return motion;
}

void Prediction::note(const InterfaceMotion& at_end, double dt) {
  const double share = dt / (dt + response_time_);
  for (std::size_t k = 0; k < state_.acceleration.size(); ++k) {
    double& a = state_.acceleration[k];
    a += share * ((at_end.velocity[k] - state_.now.velocity[k]) / dt - a);
  }
  state_.now = at_end;
  state_.now.impulse.resize(state_.acceleration.size());  // a solid that knows no impedance took none
}

}  // namespace toryu::coupling
