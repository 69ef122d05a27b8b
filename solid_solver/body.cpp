#include "solid_solver/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/scene/fill.hpp"
#include "common/scene/occupancy_index.hpp"
#include "common/scene/worn_box.hpp"

namespace toryu::solid {

static_assert(dim == 2, "regions are filled row by row in the plane");

namespace {

/// How far a fitted spacing may be from the stated one: within a worn region any depth fits from two and a
/// half rows on.
double largest_misfit(const Region& region) {
  return region.worn.empty() ? 0.1 : 0.2;
}

/// Number of cells on `side` [m] of a region; 0, told as a fault, if they do not fill it.
long cells(const Region& region, int axis, double side, double spacing, const TellFault& tell_fault) {
  const long n = std::lround(side / spacing);
  if (n >= 1 && std::abs(side / (static_cast<double>(n) * spacing) - 1.0) <= largest_misfit(region)) return n;
  tell_fault(
      "solid.region",
      fmt::format("region '{}' is {:.3g} spacings long along {}; rows of particles fill it only if that is "
                  "within {:.0f} % of a whole number",
                  region.name, side / spacing, axis == 0 ? "x" : "y", 100 * largest_misfit(region)));
  return 0;
}

/// Particles of a region one behind the other across it: from face to face, worn as they are.
struct Line {
  double place, begin;  ///< along the region, and where the first cell begins [m]
  double cell = 0;      ///< [m]
  long count = 0;
};

std::vector<Line> lines_across(const Region& region, int across, double spacing,
                               const TellFault& tell_fault) {
  const int along = 1 - across;
  const double length = region.box.max[along] - region.box.min[along];
  const long count = cells(region, along, length, spacing, tell_fault);
  std::vector<Line> lines;
  for (long k = 0; k < count; ++k) {
    const double place =
        region.box.min[along] + (static_cast<double>(k) + 0.5) * (length / static_cast<double>(count));
    const Remains left = remains_at(region.box, region.worn, across, place);
    Line line{place, left.low};
    line.count = cells(region, across, left.high - left.low, spacing, tell_fault);
    if (line.count == 0) return {};
    line.cell = (left.high - left.low) / static_cast<double>(line.count);
    lines.push_back(line);
  }
  return lines;
}

void fill_region(std::size_t index, const Parameters& parameters, Body& body, const TellFault& tell_fault) {
  const Region& region = parameters.regions[index];
  const int across = region.worn.empty() ? 1 : region.worn.front().axis(), along = 1 - across;
  const std::vector<Line> lines = lines_across(region, across, parameters.spacing, tell_fault);
  const auto place = [&](const Line& line, long k) {
    Vec X, cell;
    X[along] = line.place;
    X[across] = line.begin + (static_cast<double>(k) + 0.5) * line.cell;
    cell[along] = (region.box.max[along] - region.box.min[along]) / static_cast<double>(lines.size());
    cell[across] = line.cell;
    const bool cut = std::any_of(parameters.holes.begin(), parameters.holes.end(),
                                 [&](const NamedBox& hole) { return hole.box.contains(X); });
    if (cut || !region.box.contains(X)) return;
    body.X.push_back(X);
    body.cell.push_back(cell);
    body.region.push_back(static_cast<std::uint32_t>(index));
  };
  long longest = 0;
  for (const Line& line : lines) longest = std::max(longest, line.count);
  for (long k = 0; k < longest; ++k)
    for (const Line& line : lines)
      if (k < line.count) place(line, k);
}

/// Whether regions a and b have more than an edge in common; of round ones, whether a particle of one lies in
/// the other.
bool overlap(const Parameters& parameters, const Body& body, std::size_t a, std::size_t b) {
  const Box &A = parameters.regions[a].box, &B = parameters.regions[b].box;
  if (!A.round && !B.round) {
    const double tolerance = 1e-6 * parameters.spacing;
    return ((A.max - B.min).array() > tolerance).all() && ((B.max - A.min).array() > tolerance).all();
  }
  for (std::size_t i = 0; i < body.size(); ++i)
    if ((body.region[i] == a && B.contains(body.X[i])) || (body.region[i] == b && A.contains(body.X[i])))
      return true;
  return false;
}

void find_surface(Body& body) {
  // Half a spacing and a little: where regions meet, their columns need not face each other.
  OccupancyIndex places(0.6 * body.spacing);
  places.take(body.X, "");
  body.area_vector.assign(body.size(), Vec::Zero());
  for (std::size_t i = 0; i < body.size(); ++i)
    for (int axis = 0; axis < dim; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const Vec normal = side * Vec::Unit(axis);
        const Vec site = body.X[i] + body.cell[i][axis] * normal;
        if (places.taken(site)) continue;
        body.area_vector[i] += body.volume(i) / body.cell[i][axis] * normal;
        body.outside.push_back(site);
      }
}

}  // namespace

double Body::total_volume() const {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) sum += volume(i);
  return sum;
}

std::vector<std::uint32_t> Body::inside(const Box& box) const {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < size(); ++i)
    if (box.contains(X[i])) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

std::vector<std::uint32_t> Body::near_surface(double reach) const {
  // A hair more: where a row lies at the reach itself, rounding must not choose among its particles. A layer
  // that is pushed against water would turn aside.
  OccupancyIndex sites(reach * (1 + 1e-9));
  sites.take(outside, "");
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < size(); ++i)
    if (sites.taken(X[i])) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

Body build_body(const Parameters& parameters, const TellFault& tell_fault) {
  Body body;
  body.spacing = parameters.spacing;
  const auto& regions = parameters.regions;
  std::vector<Box> boxes;
  boxes.reserve(regions.size());
  for (const auto& region : regions) boxes.push_back(region.box);
  check_size(boxes, parameters.spacing);
  std::vector<Box> holes;
  for (const auto& hole : parameters.holes) holes.push_back(hole.box);
  body.shape = Shape(boxes, holes, parameters.spacing);
  for (std::size_t a = 0; a < regions.size(); ++a) {
    const std::size_t before = body.size();
    fill_region(a, parameters, body, tell_fault);
    for (std::size_t b = 0; b < a; ++b)
      if (overlap(parameters, body, a, b))
        tell_fault("solid.region", fmt::format("region '{}' overlaps region '{}'; regions may touch only",
                                               regions[a].name, regions[b].name));
    body.counts.emplace_back("region " + regions[a].name, body.size() - before);
  }
  body.held.assign(body.size(), 0);
  for (const auto& clamp : parameters.clamps) {
    const auto particles = body.inside(clamp.box);
    if (particles.empty())
      tell_fault("solid.clamp", fmt::format("clamp '{}' holds no particle of the solid", clamp.name));
    for (const auto i : particles) body.held[i] = 1;
    body.counts.emplace_back("clamp " + clamp.name, particles.size());
  }
  for (const auto& load : parameters.loads)
    if (body.inside(load.box).empty())
      tell_fault("solid.load", fmt::format("load '{}' acts on no particle of the solid", load.name));
  for (const auto& observer : parameters.observers) try {
      MaterialPoint(observer.point, body.X, 2.0 * parameters.h(), body.shape);
    } catch (const std::invalid_argument& error) {
      tell_fault("solid.observer", fmt::format("observer '{}': {}", observer.name, error.what()));
    }
  if (body.size() > 0) find_surface(body);
  return body;
}

}  // namespace toryu::solid
