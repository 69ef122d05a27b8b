#include "common/scene/fill.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "common/scene/fill_outline.hpp"

namespace toryu {

static_assert(dim == 2, "boxes are filled row by row in the plane");

namespace {

/// Rounding moves the edge of a box by far less than this share of a spacing, and no user means so little.
constexpr double rounding = 1e-6;
/// A body of more particles is a slip of the pen, and would take all memory before anything notices.
constexpr double largest_body = 1e8;
/// By how much of the spacing rows that fit between faces may differ from it.
constexpr double largest_misfit = 0.1;
/// Faces that are nearer than this share of a spacing have no row between them.
constexpr double least_row = 0.5;

/// By their area; those of the lattice are a row more or less.
double particles_in(const std::vector<Box>& boxes, double spacing) {
  double count = 0;
  for (const Box& box : boxes) count += ((box.max - box.min) / spacing).prod();
  return count;
}

/// Begin <= index < end.
struct Range {
  std::size_t begin, end;
};

/// Rows of cells along one axis.
struct Rows {
  std::vector<double> centre, side;  ///< [m]
  /// Those whose centre lies between two coordinates.
  Range between(double low, double high, double spacing) const {
    const auto first_at_or_above = [&](double x) {
      return static_cast<std::size_t>(std::lower_bound(centre.begin(), centre.end(), x - rounding * spacing) -
                                      centre.begin());
    };
    return {first_at_or_above(low), first_at_or_above(high)};
  }
};

/// The rows of the lattice through `origin` that may lie between two coordinates.
Rows lattice(double origin, double low, double high, double spacing) {
  Rows rows;
  const double last = std::ceil((high - origin) / spacing);
  for (double k = std::max(0.0, std::floor((low - origin) / spacing) - 1); k <= last; ++k)
    rows.centre.push_back(origin + spacing * (k + 0.5));
  rows.side.assign(rows.centre.size(), spacing);
  return rows;
}

/// Rows from face to face; `faces` are in order.
Rows fitted(const std::vector<double>& faces, int axis, double spacing, std::vector<Misfit>& misfits) {
  Rows rows;
  const double least = least_row * spacing, last = faces.back();
  std::vector<double> kept{faces.front()};
  const auto keep = [&](double face) {
    const double nearest = std::min(face - kept.back(), face < last ? last - face : face - kept.back());
    if (nearest >= least)
      kept.push_back(face);
    else if (nearest > rounding * spacing)
      misfits.push_back({axis, face - kept.back() < least ? kept.back() : face,
                         face - kept.back() < least ? face : last, 0});
  };
  for (std::size_t k = 1; k < faces.size(); ++k) keep(faces[k]);
  for (std::size_t k = 1; k < kept.size(); ++k) {
    const double width = kept[k] - kept[k - 1];
    const long count = std::max(1l, std::lround(width / spacing));
    const double side = width / static_cast<double>(count);
    if (std::abs(side / spacing - 1) > largest_misfit) misfits.push_back({axis, kept[k - 1], kept[k], count});
    for (long n = 0; n < count; ++n) {
      rows.centre.push_back(kept[k - 1] + (static_cast<double>(n) + 0.5) * side);
      rows.side.push_back(side);
    }
  }
  return rows;
}

bool touch(const Box& a, const Box& b, double distance) {
  return ((a.max - b.min).array() >= -distance).all() && ((b.max - a.min).array() >= -distance).all();
}

/// Parts whose boxes each touch another, with the holes in them.
std::vector<Blocks> groups_of(const Blocks& body, double spacing) {
  const auto& [boxes, holes] = body;
  std::vector<std::size_t> group(boxes.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (const auto old = group[a]; group[b] != old && touch(boxes[a], boxes[b], least_row * spacing))
        std::replace(group.begin(), group.end(), old, group[b]);
  std::vector<Blocks> groups;
  for (std::size_t first = 0; first < boxes.size(); ++first) {
    Blocks found;
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (group[b] == first) found.boxes.push_back(boxes[b]);
    for (const Box& hole : holes)
      if (std::any_of(found.boxes.begin(), found.boxes.end(),
                      [&](const Box& b) { return touch(hole, b, -rounding * spacing); }))
        found.holes.push_back(hole);
    if (!found.boxes.empty()) groups.push_back(std::move(found));
  }
  return groups;
}

/// The columns of a row in which a box has its centres.
Range columns_in(const Box& box, const Rows& columns, double y, double spacing) {
  Range range = columns.between(box.min[0], box.max[0], spacing);
  if (!box.round) return range;
  const auto begin = columns.centre.begin();
  const auto middle = std::clamp(columns.between(0.5 * (box.min[0] + box.max[0]), box.max[0], 0).begin,
                                 range.begin, range.end);
  const auto at = [&](std::size_t k) { return begin + static_cast<std::ptrdiff_t>(k); };
  const auto inside = [&](double x) { return box.in_ellipse({x, y}); };
  const auto first = std::partition_point(at(range.begin), at(middle), [&](double x) { return !inside(x); });
  const auto last = std::partition_point(at(middle), at(range.end), inside);
  return {static_cast<std::size_t>(first - begin), static_cast<std::size_t>(last - begin)};
}

/// What all of `boxes` have of a row, in order and each column once.
std::vector<Range> united(const std::vector<Box>& boxes, const std::vector<Range>& rows_of,
                          const Rows& columns, std::size_t row, double y, double spacing) {
  std::vector<Range> ranges, result;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (row >= rows_of[b].begin && row < rows_of[b].end)
      if (const Range in = columns_in(boxes[b], columns, y, spacing); in.begin < in.end) ranges.push_back(in);
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
  for (const Range& range : ranges)
    if (result.empty() || range.begin > result.back().end)
      result.push_back(range);
    else
      result.back().end = std::max(result.back().end, range.end);
  return result;
}

void fill_group(const Blocks& group, const Rows& columns, const Rows& rows, double spacing,
                Filling& filling) {
  std::vector<Range> filled, empty;
  for (const Box& box : group.boxes) filled.push_back(rows.between(box.min[1], box.max[1], spacing));
  for (const Box& hole : group.holes) empty.push_back(rows.between(hole.min[1], hole.max[1], spacing));
  for (std::size_t row = 0; row < rows.centre.size(); ++row) {
    const double y = rows.centre[row];
    const auto holes = united(group.holes, empty, columns, row, y, spacing);
    for (const Range& range : united(group.boxes, filled, columns, row, y, spacing))
      for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto hole = std::find_if(holes.begin(), holes.end(),
                                       [&](const Range& h) { return k >= h.begin && k < h.end; });
        if (hole != holes.end()) {
          k = hole->end - 1;
          continue;
        }
        filling.points.emplace_back(columns.centre[k], y);
        filling.cells.emplace_back(columns.side[k], rows.side[row]);
      }
  }
}

/// Coordinates of the faces of a group along an axis, and of those beside it in its range, in order.
std::vector<double> faces_of(const Blocks& group, const std::vector<Blocks>& beside, int axis) {
  std::vector<double> faces;
  for (const Box& box : group.boxes) faces.insert(faces.end(), {box.min[axis], box.max[axis]});
  std::sort(faces.begin(), faces.end());
  const double low = faces.front(), high = faces.back();
  const auto add = [&](const std::vector<Box>& boxes) {
    for (const Box& box : boxes)
      for (const double face : {box.min[axis], box.max[axis]})
        if (!box.outline && face > low && face < high) faces.push_back(face);
  };
  add(group.holes);
  for (const Blocks& other : beside) {
    const auto touches = [&](const Box& box) {
      return std::any_of(other.boxes.begin(), other.boxes.end(),
                         [&](const Box& b) { return touch(box, b, 0); });
    };
    if (std::none_of(group.boxes.begin(), group.boxes.end(), touches)) continue;
    add(other.boxes);
    add(other.holes);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

bool on_lattice(const std::vector<double>& faces, double origin, double spacing) {
  return std::all_of(faces.begin(), faces.end(), [&](double face) {
    const double rows = (face - origin) / spacing;
    return std::abs(rows - std::round(rows)) <= rounding;
  });
}

/// Row by row over all groups.
void sort_rows(Filling& filling) {
  std::vector<std::size_t> order(filling.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vec &p = filling.points[a], &q = filling.points[b];
    return p[1] != q[1] ? p[1] < q[1] : p[0] < q[0];
  });
  Filling sorted;
  for (const std::size_t i : order) {
    sorted.points.push_back(filling.points[i]);
    sorted.cells.push_back(filling.cells[i]);
  }
  filling.points.swap(sorted.points);
  filling.cells.swap(sorted.cells);
}

/// What is left of a box without the holes, if an outline bounds it anywhere.
std::optional<std::vector<Outline::Ring>> outlined(const Box& box, const std::vector<Box>& holes,
                                                   double spacing) {
  bool found = box.outline != nullptr;
  auto rings = outline_of(box).rings();
  for (const Box& hole : holes) {
    if (rings.empty() || !touch(hole, box, -rounding * spacing)) continue;
    const Outline before(rings);
    rings = difference(before, outline_of(hole));
    if (hole.outline && !found)
      found = rings.empty() || Outline(rings).area() < (1 - rounding) * before.area();
  }
  return found ? std::optional(std::move(rings)) : std::nullopt;
}

/// Fills what outlines bound, and returns the rest of the body.
Blocks fill_outlines(const Blocks& body, double spacing, Filling& filling) {
  const auto has_outline = [](const Box& box) { return box.outline != nullptr; };
  if (std::none_of(body.boxes.begin(), body.boxes.end(), has_outline) &&
      std::none_of(body.holes.begin(), body.holes.end(), has_outline))
    return body;
  Blocks rest{{}, body.holes};
  std::erase_if(rest.holes, has_outline);
  for (const Box& box : body.boxes) {
    const auto rings = outlined(box, body.holes, spacing);
    if (!rings) rest.boxes.push_back(box);
    if (!rings || rings->empty()) continue;
    const FittedFilling fitted = fill_outline(Outline(*rings), spacing);
    const auto cell = Vec::Constant(std::sqrt(fitted.volume));
    filling.points.insert(filling.points.end(), fitted.points.begin(), fitted.points.end());
    filling.cells.resize(filling.points.size(), cell);
    filling.on_lattice = false;
  }
  return rest;
}

Filling fill_rows(const Blocks& body, double spacing, const Blocks* beside) {
  Filling filling;
  if (body.boxes.empty()) return filling;
  Vec origin = body.boxes.front().min;
  for (const auto& box : body.boxes) origin = origin.cwiseMin(box.min);
  const auto groups = groups_of(body, spacing);
  const auto others = beside ? groups_of(*beside, spacing) : std::vector<Blocks>{};
  for (auto* values : {&filling.points, &filling.cells})  // which would take twice as much while they grow
    values->reserve(static_cast<std::size_t>(1.05 * particles_in(body.boxes, spacing)));
  for (const Blocks& group : groups) {
    const auto rows = [&](int axis) {
      const auto faces = faces_of(group, others, axis);
      if (!beside || on_lattice(faces, origin[axis], spacing))
        return lattice(origin[axis], faces.front(), faces.back(), spacing);
      filling.on_lattice = false;
      return fitted(faces, axis, spacing, filling.misfits);
    };
    fill_group(group, rows(0), rows(1), spacing, filling);
  }
  if (groups.size() > 1) sort_rows(filling);
  return filling;
}

/// `beside`: nothing where rows need not fit between faces.
Filling fill(const Blocks& body, double spacing, const Blocks* beside) {
  check_size(body.boxes, spacing);
  Filling outlines;
  Filling filling = fill_rows(fill_outlines(body, spacing, outlines), spacing, beside);
  filling.on_lattice = filling.on_lattice && outlines.on_lattice;
  filling.points.insert(filling.points.end(), outlines.points.begin(), outlines.points.end());
  filling.cells.insert(filling.cells.end(), outlines.cells.begin(), outlines.cells.end());
  return filling;
}

}  // namespace

void check_size(const std::vector<Box>& boxes, double spacing) {
  const double count = particles_in(boxes, spacing);
  if (count > largest_body)
    throw BadKey(".spacing", fmt::format("a spacing of {} m would fill a body with {:.1e} particles; at most "
                                         "{:.0e} are possible",
                                         spacing, count, largest_body));
}

std::vector<Vec> fill(const std::vector<Box>& boxes, const std::vector<Box>& holes, double spacing) {
  return fill({boxes, holes}, spacing, nullptr).points;
}

Filling fill_to_faces(const Blocks& body, double spacing, const Blocks& beside) {
  return fill(body, spacing, &beside);
}

}  // namespace toryu
