/// A face of a wall that has worn away: by how much it lies behind the face of the wall's box.
#pragma once

#include <vector>

#include "common/case/parameter_table.hpp"

namespace toryu {

static_assert(dim == 2, "a face is a line along the other axis");

/// Which face of a box: towards negative or positive x, towards negative or positive y.
enum class Side { left, right, lower, upper };

struct WornFace {
  Side face = Side::upper;
  /// Rows of the position along the face (x of a lower or upper one, y of the others) and the depth that has
  /// come off [m]: linear in between, constant beyond the ends.
  std::vector<std::vector<double>> depth;

  /// Across the face and along it.
  int axis() const { return face == Side::left || face == Side::right ? 0 : 1; }
  int along() const { return 1 - axis(); }
  /// 1 where the face looks towards positive coordinates, else -1.
  double outward() const { return face == Side::right || face == Side::upper ? 1.0 : -1.0; }
  double depth_at(double position) const;  ///< [m]
  double largest_depth() const;            ///< [m]
};
void describe(ParameterTable& table, WornFace& worn);

}  // namespace toryu
