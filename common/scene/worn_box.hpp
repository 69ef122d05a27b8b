/// What is left of a box whose faces have worn away.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu {

/// Requires that what is `worn` lies on the box of a `body` ("wall"), each face once, and leaves something.
void require_remains(ParameterTable& table, const Box& box, const std::vector<WornFace>& worn,
                     const std::string& body);

/// Between which coordinates along `axis` something is left at the position `s` along the other axis [m].
struct Remains {
  double low, high;
};
Remains remains_at(const Box& box, const std::vector<WornFace>& worn, int axis, double s);

}  // namespace toryu
