/// Quantities that swing: amplitude r(t) sin(2 pi f t + phase). A ramp lets them begin smoothly: with
/// s = t/ramp, r = 10 s^3 - 15 s^4 + 6 s^5 up to s = 1 and 1 from there on, so that the value, its rate and
/// the rate of that are all 0 at t = 0. Without a ramp r = 1 at all times.
#pragma once

#include <string>

#include "common/case/parameter_table.hpp"

namespace toryu {

struct Sine {
  double amplitude = 0;  ///< in the unit of what swings
  double frequency = 0;  ///< [Hz]
  double phase = 0;      ///< [rad]
  double ramp = 0;       ///< [s]
  double value_at(double t) const;
  double rate_at(double t) const;  ///< of change, by second
  bool operator==(const Sine&) const = default;
};
/// `unit` is that of the amplitude.
void describe_sine(ParameterTable& table, Sine& sine, const std::string& unit);

/// One that swings along a line.
struct DirectedSine {
  Sine sine;
  Vec direction = Vec::Zero();
  bool operator==(const DirectedSine&) const = default;
  Vec value_at(double t) const { return sine.value_at(t) * direction.normalized(); }
  Vec rate_at(double t) const { return sine.rate_at(t) * direction.normalized(); }
};
void describe_sine(ParameterTable& table, DirectedSine& sine, const std::string& unit);

}  // namespace toryu
