#include "coupler/extrapolation.hpp"

namespace toryu::coupling {

InterfaceMotion Extrapolation::over(double dt) const {
  const auto& [now, past_velocity, first_dt, last_dt] = state_;
  const double tau = order_ > 0 ? dt : first_dt > 0 ? dt - first_dt : 0.0;
  const bool curved = order_ > 1 && !past_velocity.empty();
  InterfaceMotion motion = now;
  for (std::size_t k = 0; k < motion.position.size(); ++k) {
    const double a = curved ? (now.velocity[k] - past_velocity[k]) / last_dt : 0.0;
    const double mean = now.velocity[k] + 0.5 * tau * a;
    motion.position[k] += tau * mean;
    if (order_ > 0) motion.velocity[k] = mean;
  }
  return motion;
}

void Extrapolation::note(const InterfaceMotion& at_end, double dt) {
  state_.past_velocity = state_.now.velocity;
  state_.now = at_end;
  if (state_.first_dt == 0) state_.first_dt = dt;
  state_.last_dt = dt;
}

}  // namespace toryu::coupling
