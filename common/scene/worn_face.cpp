#include "common/scene/worn_face.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/scene/rows.hpp"

namespace toryu {

double WornFace::depth_at(double position) const {
  return value_in(depth, position);
}

double WornFace::largest_depth() const {
  double largest = 0;
  for (const auto& row : depth) largest = std::max(largest, row[1]);
  return largest;
}

void describe(ParameterTable& table, WornFace& worn) {
  table.choice("face", worn.face, {"left", "right", "lower", "upper"},
               {.required = true, .help = "of the box: towards negative or positive x or y"});
  table.rows("depth", worn.depth, {"position along the face [m]", "depth [m]"},
             {.required = true, .help = "what has come off: linear in between, constant beyond the ends"});
  table.require(!worn.depth.empty(), "depth", "'depth' needs at least one row");
  for (const auto& row : worn.depth)
    table.require(row[1] >= 0, "depth",
                  fmt::format("a depth must be at least 0 [m], found {} at {}", row[1], row[0]));
  require_rising(table, "depth", worn.depth, "positions");
}

}  // namespace toryu
