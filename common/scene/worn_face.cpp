#include "common/scene/worn_face.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace toryu {

double WornFace::depth_at(double position) const {
  const auto next = std::find_if(depth.begin(), depth.end(),
                                 [&](const std::vector<double>& row) { return row[0] > position; });
  if (next == depth.begin()) return next == depth.end() ? 0.0 : (*next)[1];
  const auto& before = *std::prev(next);
  if (next == depth.end()) return before[1];
  const double share = (position - before[0]) / ((*next)[0] - before[0]);
  return before[1] + share * ((*next)[1] - before[1]);
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
  for (std::size_t k = 0; k < worn.depth.size(); ++k) {
    table.require(
        worn.depth[k][1] >= 0, "depth",
        fmt::format("a depth must be at least 0 [m], found {} at {}", worn.depth[k][1], worn.depth[k][0]));
    if (k > 0)
      table.require(worn.depth[k][0] > worn.depth[k - 1][0], "depth",
                    fmt::format("positions in 'depth' must increase: {} comes after {}", worn.depth[k][0],
                                worn.depth[k - 1][0]));
  }
}

}  // namespace toryu
