#include <cmath>

#include "common/scene/scene.hpp"

namespace toryu {

namespace {

using Index = Eigen::Array<long, dim, 1>;

/// Lattice points with begin <= index < end.
struct IndexBox {
  Index begin, end;
  bool contains(const Index& index) const { return (index >= begin).all() && (index < end).all(); }
};

/// Rounding moves the edge of a box by far less than this share of a spacing, and no user means so little.
constexpr double rounding = 1e-6;

IndexBox lattice_range(const Box& box, const Vec& origin, double spacing) {
  const auto first_at_or_above = [&](const Vec& corner) -> Index {
    return ((corner - origin).array() / spacing - 0.5 - rounding).ceil().cast<long>();
  };
  return {first_at_or_above(box.min), first_at_or_above(box.max)};
}

/// A body of more particles is a slip of the pen, and would take all memory before anything notices.
constexpr double largest_body = 1e8;

/// Whether one of `boxes`, whose lattice ranges are `ranges`, holds the lattice point `index` at x [m].
bool in_any(const std::vector<IndexBox>& ranges, const std::vector<Box>& boxes, const Index& index,
            const Vec& x) {
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (ranges[b].contains(index) && (!boxes[b].round || boxes[b].in_ellipse(x))) return true;
  return false;
}

}  // namespace

void check_size(const std::vector<Box>& boxes, double spacing) {
  double count = 0;
  for (const auto& box : boxes) count += ((box.max - box.min) / spacing).prod();
  if (count > largest_body)
    throw BadInput({{.place = fmt::format("spacing = {} m", spacing),
                     .message = fmt::format("would fill a body with {:.1e} particles; at most {:.0e} are "
                                            "possible",
                                            count, largest_body)}});
}

std::vector<Vec> fill(const std::vector<Box>& boxes, const std::vector<Box>& holes, double spacing) {
  std::vector<Vec> points;
  if (boxes.empty()) return points;
  check_size(boxes, spacing);
  Vec origin = boxes.front().min;
  for (const auto& box : boxes) origin = origin.cwiseMin(box.min);

  std::vector<IndexBox> filled, empty;
  for (const auto& box : boxes) filled.push_back(lattice_range(box, origin, spacing));
  for (const auto& hole : holes) empty.push_back(lattice_range(hole, origin, spacing));
  Index end = filled.front().end;
  for (const auto& box : filled) end = end.max(box.end);

  // Counts up like the digits of a clock, the first axis fastest.
  for (Index index = Index::Zero(); index[dim - 1] < end[dim - 1];) {
    const Vec x = origin + spacing * (index.cast<double>() + 0.5).matrix();
    if (in_any(filled, boxes, index, x) && !in_any(empty, holes, index, x)) points.push_back(x);
    ++index[0];
    for (int axis = 0; axis + 1 < dim && index[axis] >= end[axis]; ++axis) {
      index[axis] = 0;
      ++index[axis + 1];
    }
  }
  return points;
}

}  // namespace toryu
