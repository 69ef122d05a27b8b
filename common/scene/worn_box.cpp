#include "common/scene/worn_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace toryu {

namespace {

std::string name_of(const WornFace& worn) {
  return std::array{"left", "right", "lower", "upper"}[static_cast<std::size_t>(worn.face)];
}

}  // namespace

void require_remains(ParameterTable& table, const Box& box, const std::vector<WornFace>& worn,
                     const std::string& body) {
  if (worn.empty()) return;
  table.require(box.is_rectangle(), "worn",
                fmt::format("a {} that is no box has no faces that could be 'worn'", body));
  Vec largest = Vec::Zero();  // off either axis
  for (const WornFace& face : worn) {
    largest[face.axis()] += face.largest_depth();
    const auto same = [&](const WornFace& other) { return other.face == face.face; };
    table.require(&face == &*std::find_if(worn.begin(), worn.end(), same), "worn",
                  fmt::format("the {} face is 'worn' twice", name_of(face)));
    const double low = box.min[face.along()], high = box.max[face.along()];
    const double rounding = 1e-6 * (high - low);
    for (const auto& row : face.depth)
      table.require(row[0] >= low - rounding && row[0] <= high + rounding, "worn",
                    fmt::format("positions along the {} face lie between {} and {} [m], found {}",
                                name_of(face), low, high, row[0]));
  }
  for (int axis = 0; axis < dim; ++axis) {
    const double thickness = box.max[axis] - box.min[axis];
    table.require(largest[axis] < thickness, "worn",
                  fmt::format("the depths along {} add up to {} [m]: the {} is only {:.6g} [m] thick",
                              "xy"[axis], largest[axis], body, thickness));
  }
}

Remains remains_at(const Box& box, const std::vector<WornFace>& worn, int axis, double s) {
  Remains left{box.min[axis], box.max[axis]};
  for (const WornFace& face : worn)
    if (face.axis() == axis) (face.outward() > 0 ? left.high : left.low) -= face.outward() * face.depth_at(s);
  return left;
}

}  // namespace toryu
