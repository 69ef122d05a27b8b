/// What a case says of the open ends of its channels: `[[fluid.inlet]]` and `[[fluid.outlet]]`.
#pragma once

#include <string>

#include "common/scene/rows.hpp"

namespace toryu::fluid {

/// A straight line across a channel, from wall to wall, along x or y.
struct OpenEnd {
  std::string name;
  Vec from = Vec::Zero(), to = Vec::Zero();  ///< its ends [m]
};

enum class InflowProfile { uniform, parabolic };
/// Where fluid comes in with a given velocity, at right angles to the line.
struct Inlet : OpenEnd {
  InflowProfile profile = InflowProfile::uniform;
  double mean_speed = 0, largest_speed = 0;  ///< of the profile, one of the two [m/s]
  Rows speeds = {};                          ///< in its place: distance from `from` [m], speed [m/s]
  double ramp_time = 0;                      ///< [s]
  Rows over_time = {};                       ///< in its place: time [s], share of the speed

  /// Into the fluid, at `distance` [m] from `from`: by the profile times `share_at`.
  double speed_at(double distance, double time) const;
  /// (1 - cos(pi t/T))/2 up to the end T of a ramp, 1 from there on; or that of the table.
  double share_at(double time) const;
  double mean_at(double time) const;  ///< over the line, at `time` [s] [m/s]
  double largest_speed_ever() const;  ///< [m/s]
};
void describe(ParameterTable& table, Inlet& inlet);

/// Where fluid leaves against a given pressure.
struct Outlet : OpenEnd {
  double pressure = 0;      ///< above the background pressure, at the middle of the line [Pa]
  Rows pressure_rows = {};  ///< in its place: time [s], pressure [Pa]
  double pressure_at(double time) const;
};
void describe(ParameterTable& table, Outlet& outlet);

}  // namespace toryu::fluid
