/// The section of an imaginary medium, with a parameter of each kind.
#pragma once

#include <optional>

#include "common/scene/scene.hpp"

namespace toryu {

struct Drag {
  double coefficient = 1;
};
inline void describe(ParameterTable& table, Drag& drag) {
  table.number("coefficient", drag.coefficient, {.minimum = 0, .maximum = 2, .help = "of the drag"});
}

struct Region {
  std::string name;
  Box box;
};
inline void describe(ParameterTable& table, Region& region) {
  table.text("name", region.name, {.required = true});
  table.group("box", region.box, "filled");
}

enum class Law { linear, quadratic };

struct Medium {
  double density = 0;
  double ratio = 1.3;
  int steps = 2;
  bool open = false;
  std::string label = "medium";
  Law law = Law::linear;
  std::vector<std::string> loads = {"pressure"};
  Vec wind = Vec::Zero();
  std::vector<std::vector<double>> history = {};
  std::optional<Drag> drag;
  std::vector<Region> regions;
};
inline void describe(ParameterTable& table, Medium& medium) {
  table.number("density", medium.density,
               {.unit = "kg/m3", .minimum = 0, .above_minimum = true, .required = true, .help = "at rest"});
  table.number("ratio", medium.ratio, {.minimum = 1, .maximum = 2});
  table.integer("steps", medium.steps, {.minimum = 1});
  table.flag("open", medium.open, "whether it is open");
  table.text("label", medium.label, {});
  table.choice("law", medium.law, {"linear", "quadratic"}, {.help = "of the drag"});
  table.texts("loads", medium.loads, {.help = "that are felt", .allowed = {"pressure", "viscous"}});
  table.vector("wind", medium.wind, {.unit = "m/s"});
  table.rows("history", medium.history, {"time [s]", "level [m]"}, {});
  table.optional("drag", medium.drag, "resistance");
  table.list("region", medium.regions, "filled regions");
}

}  // namespace toryu
