#include "fluid_solver/open_ends/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace toryu::fluid {

namespace {

void describe_line(ParameterTable& table, OpenEnd& end) {
  table.text(
      "name", end.name,
      {.required = true, .help = "by which columns of fluid.csv call this end", .names_columns = true});
  table.vector("from", end.from,
               {.unit = "m",
                .required = true,
                .help = "one end of the line across the channel, on a wall; the region of the fluid ends at "
                        "the line, and the walls go on beyond it"});
  table.vector("to", end.to, {.unit = "m", .required = true, .help = "the other end, on the wall opposite"});
  const Vec length = end.to - end.from;
  table.require(length[0] == 0 || length[1] == 0, "to",
                "an open end lies along x or y: 'from' and 'to' must have the same x or the same y");
  table.require(!length.isZero(0), "to", "'from' and 'to' are one point");
}

double largest_of_column(const Rows& rows) {
  double largest = 0;
  for (const auto& row : rows) largest = std::max(largest, std::abs(row[1]));
  return largest;
}

}  // namespace

void describe(ParameterTable& table, Inlet& inlet) {
  describe_line(table, inlet);
  table.choice("profile", inlet.profile, {"uniform", "parabolic"},
               {.help = "of the speed across the channel; parabolic: 0 at both ends of the line"});
  table.number("mean_speed", inlet.mean_speed,
               {.unit = "m/s", .minimum = 0, .help = "of the profile, into the fluid"});
  table.number("largest_speed", inlet.largest_speed,
               {.unit = "m/s", .minimum = 0, .help = "of the profile, in the place of its mean"});
  table.rows("speeds", inlet.speeds, {"distance [m]", "speed [m/s]"},
             {.help = "in the place of a profile: over the distance from 'from', linear in between"});
  require_rising(table, "speeds", inlet.speeds, "distances");
  table.number("ramp_time", inlet.ramp_time,
               {.unit = "s",
                .minimum = 0,
                .help = "in which the speed rises from 0 by a cosine; 0: it is there at once"});
  table.rows("over_time", inlet.over_time, {"time [s]", "share [1]"},
             {.help = "in the place of a ramp: by what the speed is multiplied, linear in between, constant "
                      "before and after"});
  require_rising(table, "over_time", inlet.over_time, "times");
  const int given =
      (inlet.mean_speed > 0 ? 1 : 0) + (inlet.largest_speed > 0 ? 1 : 0) + (inlet.speeds.empty() ? 0 : 1);
  table.require(given == 1, given == 0 ? "" : "speeds",
                "an inlet needs one of 'mean_speed', 'largest_speed' (above 0) and 'speeds'");
  table.require(inlet.speeds.empty() || inlet.profile == InflowProfile::uniform, "profile",
                "'speeds' are the profile: leave 'profile' out");
  table.require(inlet.ramp_time == 0 || inlet.over_time.empty(), "ramp_time",
                "either 'ramp_time' or 'over_time' says how the speed begins");
}

double Inlet::share_at(double time) const {
  if (!over_time.empty()) return value_in(over_time, time);
  if (ramp_time == 0 || time >= ramp_time) return 1;
  return 0.5 * (1 - std::cos(std::numbers::pi * std::max(time, 0.0) / ramp_time));
}

double Inlet::speed_at(double distance, double time) const {
  const double share = share_at(time);
  if (!speeds.empty()) return share * value_in(speeds, distance);
  if (profile == InflowProfile::uniform) return share * (mean_speed > 0 ? mean_speed : largest_speed);
  const double place = distance / (to - from).norm();
  const double largest = largest_speed > 0 ? largest_speed : 1.5 * mean_speed;
  return share * largest * 4 * place * (1 - place);
}

double Inlet::mean_at(double time) const {
  const double length = (to - from).norm();
  if (speeds.empty())  // a parabola has two thirds of its largest
    return profile == InflowProfile::parabolic ? 2 * speed_at(0.5 * length, time) / 3 : speed_at(0, time);
  std::vector<double> knots{0, length};
  for (const auto& row : speeds)
    if (row[0] > 0 && row[0] < length) knots.push_back(row[0]);
  std::sort(knots.begin(), knots.end());
  double sum = 0;  // exact of lines between knots
  for (std::size_t k = 1; k < knots.size(); ++k)
    sum += 0.5 * (knots[k] - knots[k - 1]) * (speed_at(knots[k - 1], time) + speed_at(knots[k], time));
  return sum / length;
}

double Inlet::largest_speed_ever() const {
  const double of_profile = !speeds.empty()                       ? largest_of_column(speeds)
                            : largest_speed > 0                   ? largest_speed
                            : profile == InflowProfile::parabolic ? 1.5 * mean_speed
                                                                  : mean_speed;
  return of_profile * (over_time.empty() ? 1 : largest_of_column(over_time));
}

void describe(ParameterTable& table, Outlet& outlet) {
  describe_line(table, outlet);
  table.number("pressure", outlet.pressure,
               {.unit = "Pa",
                .help = "at the middle of the line, above a [fluid.background_pressure]; across the channel "
                        "gravity adds its own"});
  table.rows("pressure_over_time", outlet.pressure_rows, {"time [s]", "pressure [Pa]"},
             {.help = "in its place: linear in between, constant before and after"});
  require_rising(table, "pressure_over_time", outlet.pressure_rows, "times");
  table.require(outlet.pressure == 0 || outlet.pressure_rows.empty(), "pressure",
                "either 'pressure' or 'pressure_over_time' says the pressure");
}

double Outlet::pressure_at(double time) const {
  return pressure_rows.empty() ? pressure : value_in(pressure_rows, time);
}

}  // namespace toryu::fluid
