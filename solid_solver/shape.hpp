/// Where there is material: a bond between two particles must lie in it, for a force does not cross empty
/// space.
#pragma once

#include <vector>

#include "common/scene/scene.hpp"

namespace toryu::solid {

class Shape {
 public:
  /// Material everywhere.
  Shape() = default;
  /// `regions` less `holes` [m]. The particles know a round face to a share of `spacing` [m] alone, and a
  /// bond may pass it by as much.
  Shape(std::vector<Box> regions, std::vector<Box> holes, double spacing);

  /// Whether the way from `a` to `b` [m], two points of the material, lies in it all along: the straight one,
  /// or one round a corner that is hardly longer. Regions that touch are one.
  bool joins(const Vec& a, const Vec& b) const;
  /// Whether the straight way from `a` to `b` [m] lies in the material all along.
  bool sees(const Vec& a, const Vec& b) const;
  /// Whether it joins any two of its points.
  bool is_convex() const {
    return holes_.empty() && (regions_.empty() || (regions_.size() == 1 && !regions_[0].outline));
  }

 private:
  std::vector<Box> regions_, holes_;
  std::vector<Vec> corners_;           ///< of those that are not round, nor nearly so [m]
  double tolerance_ = 0, detour_ = 0;  ///< of lengths; by how much a bond may be longer than straight [m]
};

}  // namespace toryu::solid
