#include "fluid_solver/wall_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace toryu::fluid {

static_assert(dim == 2, "the other axis is the one along a face");

namespace {

/// What rows may be off by, over the spacing.
constexpr double row_tolerance = 0.1;

/// The whole numbers of rows next to `rows` as lengths.
std::string fitting_sizes(double rows, double spacing) {
  const double below = std::floor(rows) * spacing, above = std::ceil(rows) * spacing;
  return below > 0 ? fmt::format("{:.6g} or {:.6g} m", below, above) : fmt::format("{:.6g} m", above);
}

/// How far a length is from a whole number of spacings, over the spacing.
double off_rows(double length, double spacing) {
  return std::abs(length / spacing - std::round(length / spacing));
}

Box mirrored(const Box& box) {
  return {-box.max, -box.min, box.round};
}

/// Whether a face of the fluid that lies at `face` along `axis`, one of `box`, is the wall's towards positive
/// `axis`.
bool lies_on(const Box& wall, double face, const Box& box, int axis, double spacing) {
  const int along = 1 - axis;
  return box.is_rectangle() && std::abs(face - wall.max[axis]) < 0.5 * spacing &&
         box.min[along] < wall.max[along] && box.max[along] > wall.min[along];
}

/// Whether fluid starts on that face of `wall` that lies towards positive `axis`: a region does, or a hole
/// ends there.
bool starts_on(const Box& wall, const Blocks& fluid, int axis, double spacing) {
  const auto has = [&](const std::vector<Box>& boxes, Vec Box::*corner) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
      return lies_on(wall, (box.*corner)[axis], box, axis, spacing);
    });
  };
  return has(fluid.boxes, &Box::min) || has(fluid.holes, &Box::max);
}

bool touches(const Box& wall, Blocks fluid, int axis, double spacing) {
  if (starts_on(wall, fluid, axis, spacing)) return true;
  for (auto* boxes : {&fluid.boxes, &fluid.holes})
    for (Box& box : *boxes) box = mirrored(box);
  return starts_on(mirrored(wall), fluid, axis, spacing);
}

/// Whether a wall, filled from its smallest corner, ends beside the face along `axis` that fluid starts on.
bool is_misplaced(const Wall& wall, int axis, const Parameters& p) {
  return wall.box.is_rectangle() &&
         off_rows(wall.box.max[axis] - wall.box.min[axis], p.spacing) > row_tolerance &&
         starts_on(wall.box, blocks_of(p), axis, p.spacing);
}

/// Whether the fluid's rows meet those of the wall along `axis` out of line, where that matters.
bool is_out_of_line(const Wall& wall, int axis, const Parameters& p, const Vec& gravity) {
  const Blocks fluid = blocks_of(p);
  if (fluid.boxes.empty() || !touches(wall.box, fluid, axis, p.spacing)) return false;
  const int along = 1 - axis;
  const auto any_off = [&](double origin, double low, double high) {
    for (const auto* boxes : {&fluid.boxes, &fluid.holes})
      for (const Box& box : *boxes)
        for (const double face : {box.min[along], box.max[along]})
          if (!box.outline && face >= low && face <= high &&
              off_rows(face - origin, p.spacing) > row_tolerance)
            return true;
    return false;
  };
  const double low = wall.box.min[along], high = wall.box.max[along];
  const bool bears = std::abs(gravity[axis]) > std::abs(gravity[along]);
  return any_off(low, low, high) && (bears || any_off(fluid.boxes.front().min[along], low, high));
}

bool takes_rows_of_fluid(const Wall& wall, const Parameters& p, const Vec& gravity) {
  if (!wall.box.is_rectangle()) return false;
  for (const int axis : {0, 1})
    if (is_misplaced(wall, axis, p) || is_out_of_line(wall, axis, p, gravity)) return true;
  return false;
}

}  // namespace

Blocks blocks_of(const Parameters& p) {
  Blocks fluid{{}, {p.holes.begin(), p.holes.end()}};
  for (const auto& region : p.regions) fluid.boxes.push_back(region.box);
  return fluid;
}

void leave_out(const std::vector<Box>& bodies, Parameters& p) {
  for (const Box& body : bodies) static_cast<Box&>(p.holes.emplace_back()) = body;
}

void repeat_holes(const Period& period, Parameters& p) {
  const Blocks fluid = blocks_of(p);
  leave_out(images_in(fluid.boxes, fluid.holes, period, row_tolerance * p.spacing), p);
}

Filling fill_wall(const Wall& wall, const Parameters& p, const Vec& gravity) {
  if (wall.box.outline || takes_rows_of_fluid(wall, p, gravity))
    return fill_to_faces({{wall.box}, {}}, p.spacing, blocks_of(p));
  const auto points = fill({wall.box}, {}, p.spacing);
  return {
      .points = points, .cells = std::vector<Vec>(points.size(), Vec::Constant(p.spacing)), .misfits = {}};
}

std::vector<std::string> misplaced_faces(const std::vector<Wall>& walls, const Parameters& p) {
  std::vector<std::string> said;
  for (const Wall& wall : walls)
    for (int axis = 0; axis < dim; ++axis) {
      const double rows = (wall.box.max[axis] - wall.box.min[axis]) / p.spacing;
      const double thickness = rows / std::max(1.0, std::round(rows));  // of the rows that fit
      if (!is_misplaced(wall, axis, p) || std::abs(thickness - 1) <= row_tolerance) continue;
      said.push_back(fmt::format(
          "wall '{}' is {:.4g} spacings long along {}: its last row stands {:.2f} spacings from "
          "its face, not 0.5, and fluid may sink in or leave a gap; take {}",
          wall.name, rows, axis == 0 ? 'x' : 'y', 0.5 * thickness, fitting_sizes(rows, p.spacing)));
    }
  return said;
}

std::string misfit_text(const Misfit& misfit, double spacing) {
  const double rows = (misfit.end - misfit.begin) / spacing;
  const std::string where =
      fmt::format("between {0} = {1:.6g} and {0} = {2:.6g} m", "xy"[misfit.axis], misfit.begin, misfit.end);
  if (misfit.rows == 0)
    return fmt::format(
        "{}, {:.2g} spacings apart, is no room for a row of the fluid: one of the two faces is "
        "passed over, and fluid is missing or too much there; take {}",
        where, rows, fitting_sizes(rows, spacing));
  return fmt::format(
      "the fluid {} is {:.3g} spacings wide: its {} row{} {:.0f} % {} than the spacing; take {}", where, rows,
      misfit.rows, misfit.rows == 1 ? " is" : "s are",
      100 * std::abs(rows / static_cast<double>(misfit.rows) - 1),
      rows > static_cast<double>(misfit.rows) ? "wider" : "narrower", fitting_sizes(rows, spacing));
}

}  // namespace toryu::fluid
