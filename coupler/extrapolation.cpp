#include "coupler/extrapolation.hpp"

namespace toryu::coupling {

InterfaceMotion Extrapolation::over(double dt) const {
  const double tau = order_ > 0 ? dt : first_dt_ > 0 ? dt - first_dt_ : 0.0;
  const bool curved = order_ > 1 && !past_velocity_.empty();
  InterfaceMotion motion = now_;
  for (std::size_t k = 0; k < motion.position.size(); ++k) {
    const double a = curved ? (now_.velocity[k] - past_velocity_[k]) / last_dt_ : 0.0;
    const double mean = now_.velocity[k] + 0.5 * tau * a;
    motion.position[k] += tau * mean;
    if (order_ > 0) motion.velocity[k] = mean;
  }
  return motion;
}

void Extrapolation::note(const InterfaceMotion& at_end, double dt) {
  past_velocity_ = now_.velocity;
  now_ = at_end;
  if (first_dt_ == 0) first_dt_ = dt;
  last_dt_ = dt;
}

}  // namespace toryu::coupling
