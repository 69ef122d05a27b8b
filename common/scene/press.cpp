#include <fmt/format.h>

#include <numbers>

#include "common/scene/rows.hpp"
#include "common/scene/scene.hpp"

namespace toryu {

namespace {

int axis_of(Direction direction) {
  return direction == Direction::plus_x || direction == Direction::minus_x ? 0 : 1;
}

}  // namespace

Vec Press::axis() const {
  const bool positive = direction == Direction::plus_x || direction == Direction::plus_y;
  return (positive ? 1 : -1) * Vec::Unit(axis_of(direction));
}

double Press::pressure_at(double time, double area) const {
  return force.empty() ? value_in(pressure, time) : value_in(force, time) / area;
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
    require_rising(table, key, values, "times");
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
