#include "common/scene/sine.hpp"

#include <cmath>
#include <numbers>

namespace toryu {

namespace {

struct Ramp {
  double share, rate;  ///< r and dr/dt [1/s]
};

Ramp ramp_at(double t, double length) {
  if (t >= length) return {1, 0};
  if (t <= 0) return {0, 0};
  const double s = t / length;
  return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s) / length};
}

}  // namespace

double Sine::value_at(double t) const {
  const double omega = 2 * std::numbers::pi * frequency;
  const double r = ramp > 0 ? ramp_at(t, ramp).share : 1;
  return amplitude * r * std::sin(omega * t + phase);
}

double Sine::rate_at(double t) const {
  const double omega = 2 * std::numbers::pi * frequency;
  const Ramp r = ramp > 0 ? ramp_at(t, ramp) : Ramp{1, 0};
  return amplitude * (r.rate * std::sin(omega * t + phase) + r.share * omega * std::cos(omega * t + phase));
}

void describe_sine(ParameterTable& table, Sine& sine, const std::string& unit) {
  table.number("amplitude", sine.amplitude, {.unit = unit, .required = true, .help = "of the sine"});
  table.number("frequency", sine.frequency,
               {.unit = "Hz", .minimum = 0, .above_minimum = true, .required = true, .help = "of the sine"});
  table.number("phase", sine.phase, {.unit = "rad", .help = "at t = 0"});
  table.number("ramp", sine.ramp,
               {.unit = "s", .minimum = 0, .help = "in which it smoothly begins, from t = 0; 0: at once"});
}

void describe_sine(ParameterTable& table, DirectedSine& sine, const std::string& unit) {
  describe_sine(table, sine.sine, unit);
  table.vector("direction", sine.direction,
               {.required = true, .help = "along which it swings, of any length"});
  table.require(!sine.direction.isZero(0), "direction", "'direction' must not be zero");
}

}  // namespace toryu
