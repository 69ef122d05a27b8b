#include "fluid_solver/boundary_motion.hpp"

#include <algorithm>

namespace toryu::fluid {

double PressedMotion::way_at(double t) const {
  return std::clamp(way + speed * (t - time), press.travel[0], press.travel[1]);
}

double PressedMotion::speed_at(double t) const {
  const double now = way_at(t);
  const bool stopped = (speed > 0 && now == press.travel[1]) || (speed < 0 && now == press.travel[0]);
  return stopped ? 0 : speed;
}

void PressedMotion::push(double t, double dt, const Vec& reaction, double held, double met) {
  const double before = speed_at(t);
  way = way_at(t);
  time = t;
  speed = before + dt / mass * (met * (press.pressure_at(t, area) - held) + reaction.dot(press.axis()));
  pushed_on = speed != speed_at(t);
  speed = speed_at(t);
  acceleration = (speed - before) / dt;
  mean_speed = 0.5 * (before + speed);
}

void PressedMotion::begin_step(double middle, double end) {
  const double way_there = way_at(middle);
  speed = speed_at(middle);
  way = way_there;
  time = end;
}

void PressedMotion::end_step(double dt, double found) {
  acceleration = (found - speed) / dt;
  speed = mean_speed = found;
  way = std::clamp(way + 0.5 * dt * found, press.travel[0], press.travel[1]);
}

}  // namespace toryu::fluid
