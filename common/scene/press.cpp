#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "common/scene/scene.hpp"

namespace toryu {

namespace {

using Rows = std::vector<std::vector<double>>;

/// The second column at `time`: linear between the rows, constant beyond them.
double value_at(const Rows& rows, double time) {
  const auto later = [](double t, const std::vector<double>& row) { return t < row[0]; };
  const auto next = std::upper_bound(rows.begin(), rows.end(), time, later);
  if (next == rows.begin()) return next->at(1);
  const auto& last = *(next - 1);
  if (next == rows.end()) return last[1];
  return last[1] + (time - last[0]) / ((*next)[0] - last[0]) * ((*next)[1] - last[1]);
}

int axis_of(Direction direction) {
  return direction == Direction::plus_x || direction == Direction::minus_x ? 0 : 1;
}

}  // namespace

Vec Press::axis() const {
  const bool positive = direction == Direction::plus_x || direction == Direction::plus_y;
  return (positive ? 1 : -1) * Vec::Unit(axis_of(direction));
}

double Press::pressure_at(double time, double area) const {
  return force.empty() ? value_at(pressure, time) : value_at(force, time) / area;
}

double pressing_area(const Wall& wall, Geometry geometry) {
  const int along = 1 - axis_of(wall.press->direction);
  const double low = wall.box.min[along], high = wall.box.max[along];
  return geometry == Geometry::plane ? high - low : std::numbers::pi * (high * high - low * low);
}

Box swept_box(const Wall& wall) {
  Box box = wall.box;
  if (!wall.press) return box;
  for (const double way : wall.press->travel) {
    const Vec shift = way * wall.press->axis();
    box.min = box.min.cwiseMin(wall.box.min + shift);
    box.max = box.max.cwiseMax(wall.box.max + shift);
  }
  return box;
}

void describe(ParameterTable& table, Press& press) {
  const auto rows = [&](const std::string& key, Rows& values, const std::string& unit) {
    table.rows(key, values, {"time [s]", key + " [" + unit + "]"},
               {.help = "on the fluid, linear in between, constant before and after"});
    for (std::size_t k = 1; k < values.size(); ++k)
      table.require(
          values[k][0] > values[k - 1][0], key,
          fmt::format("times in '{}' must increase: {} comes after {}", key, values[k][0], values[k - 1][0]));
  };
  rows("pressure", press.pressure, "Pa");
  rows("force", press.force, "N/m");
  table.require(press.pressure.empty() != press.force.empty(), "pressure",
                "a press needs rows of either its 'pressure' or its 'force'");
  table.choice("direction", press.direction, {"+x", "-x", "+y", "-y"},
               {.required = true, .help = "in which it presses, the only axis along which it moves"});
  table.vector("travel", press.travel,
               {.unit = "m",
                .required = true,
                .help = "how far it can move against and along that direction: a number at most 0 and one at "
                        "least 0; there are its stops"});
  table.require(press.travel[0] <= 0 && press.travel[1] >= 0, "travel",
                "'travel' begins at most at 0 and ends at least there: [-0.01, 0.02]");
  table.require(press.travel[0] < press.travel[1] || press.travel[0] > 0, "travel",
                "by its 'travel' the wall cannot move: give it a way, [-0.01, 0.02], or no 'press'");
  table.number("mass", press.mass,
               {.unit = "kg/m",
                .minimum = 0,
                .help = "of the piston; 0: that of fluid of four smoothing lengths in its place"});
}

}  // namespace toryu
