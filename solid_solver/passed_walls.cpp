#include "solid_solver/passed_walls.hpp"

#include <algorithm>

#include "common/run/log.hpp"

namespace toryu::solid {

namespace {

/// Places of a wall's body as the case draws it, for places at `time` [s].
class Inside {
 public:
  Inside(const Wall& wall, double time) : box_(wall.box) {
    if (wall.motion) pose_ = wall.motion->pose_at(time);
  }
  bool operator()(const Vec& x) const {
    return box_.contains(pose_.about + pose_.rotation.transpose() * (x - pose_.centre));
  }
  /// Whether the middles of the sides of a cell are inside.
  bool all_of(const Vec& x, double side) const {
    for (int a = 0; a < dim; ++a)
      for (const double way : {-0.5 * side, 0.5 * side})
        if (!(*this)(x + way * Vec::Unit(a))) return false;
    return true;
  }

 private:
  const Box& box_;
  Pose pose_;
};

}  // namespace

PassedWalls::PassedWalls(const std::vector<Wall>& walls, const std::vector<Vec>& X, double spacing)
    : walls_(walls), spacing_(spacing) {
  std::vector<std::uint8_t> held(X.size(), 0);
  for (const Wall& wall : walls_) {
    const Inside inside(wall, 0);
    for (std::size_t i = 0; i < X.size(); ++i) held[i] |= inside(X[i]);
  }
  for (std::uint32_t i = 0; i < X.size(); ++i)
    if (!held[i]) free_.push_back(i);
}

void PassedWalls::check(const std::vector<Vec>& x, double time) {
  for (const Wall& wall : walls_) {
    const Inside inside(wall, time);
    const auto found = std::find_if(free_.begin(), free_.end(),
                                    [&](std::uint32_t i) { return inside.all_of(x[i], spacing_); });
    if (found == free_.end()) continue;
    log::warn(
        "the solid passes through wall '{}': particle {} is in it at ({:.4g}, {:.4g}) m, t = {:.6g} s; "
        "[solid.wall_contact] makes them touch",
        wall.name, *found, x[*found][0], x[*found][1], time);
    free_.clear();
    return;
  }
}

}  // namespace toryu::solid
