#include "solid_solver/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "common/run/log.hpp"
#include "common/scene/fill.hpp"
#include "common/scene/fill_outline.hpp"
#include "common/scene/occupancy_index.hpp"
#include "common/scene/period.hpp"
#include "common/scene/worn_box.hpp"

namespace toryu::solid {

static_assert(dim == 2, "regions are filled row by row in the plane");

namespace {

/// How far a fitted spacing may be from the stated one: within a worn region any depth fits from two and a
/// half rows on.
double largest_misfit(const Region& region) {
  return region.worn.empty() ? 0.1 : 0.2;
}
constexpr std::chrono::seconds between_words{2};  // while particles are fitted
/// Over the spacing: pieces of a surface, how far beyond it is looked for another region, and how far the
/// particle of a piece may be, in a sharp corner.
constexpr double longest_piece = 1.0 / 8, beside = 0.01, furthest_particle = 4;

/// Number of cells on `side` [m] of a region; 0, told as a fault, if they do not fill it.
long cells(const Region& region, int axis, double side, double spacing, const TellFault& tell_fault) {
  const long n = std::lround(side / spacing);
  if (n >= 1 && std::abs(side / (static_cast<double>(n) * spacing) - 1.0) <= largest_misfit(region)) return n;
  tell_fault(
      item("region", region.name, region.shape.place()),
      fmt::format("region '{}' is {:.3g} spacings long along {}; rows of particles fill it only if that is "
                  "within {:.0f} % of a whole number",
                  region.name, side / spacing, axis == 0 ? "x" : "y", 100 * largest_misfit(region)));
  return 0;
}

bool touch(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

/// Whether particles fit a region's outline rather than a lattice.
bool is_fitted(const Region& region, const std::vector<NamedBox>& holes) {
  return region.box.outline || std::any_of(holes.begin(), holes.end(), [&](const NamedBox& hole) {
           return hole.box.outline && touch(hole.box, region.box);
         });
}

/// The outline of a region without the holes; none, told as a fault, if that is none.
std::optional<Outline> outline_without(const Region& region, const std::vector<NamedBox>& holes,
                                       const TellFault& tell_fault) {
  Outline outline = outline_of(region.box);
  for (const auto& hole : holes) {
    if (!touch(hole.box, region.box)) continue;
    auto rings = difference(outline, outline_of(hole.box));
    if (const auto fault = fault_of(rings)) {
      tell_fault(
          item("hole", hole.name, hole.shape.place()),
          fmt::format("what hole '{}' leaves of region '{}' {}", hole.name, region.name, fault->message));
      return std::nullopt;
    }
    outline = Outline(std::move(rings));
  }
  return outline;
}

void fit_region(std::size_t index, const Outline& outline, const Parameters& parameters, Body& body,
                const TellFault& tell_fault) {
  const std::string& name = parameters.regions[index].name;
  auto said = std::chrono::steady_clock::now();
  const auto tell = [&](double share) {
    if (std::chrono::steady_clock::now() - said < between_words) return;
    said = std::chrono::steady_clock::now();
    log::info("particles are fitted to region '{}': {:.0f} %", name, 100 * share);
  };
  const FittedFilling filling = fill_outline(outline, parameters.spacing, tell);
  if (filling.points.empty())
    tell_fault(item("region", name, parameters.regions[index].shape.place()),
               fmt::format("region '{}' is nowhere as wide as a row of particles", name));
  body.spread = std::max(body.spread, filling.spread);
  body.X.insert(body.X.end(), filling.points.begin(), filling.points.end());
  body.cell.resize(body.size(), Vec::Constant(std::sqrt(filling.volume)));
  body.region.resize(body.size(), static_cast<std::uint32_t>(index));
}

/// Particles of a region one behind the other across it: from face to face, worn as they are.
struct Line {
  double begin;     ///< of the first cell [m]
  double cell = 0;  ///< [m]
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
    Line line{left.low};
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
  const auto place = [&](std::size_t n, long k) {
    Vec begin = region.box.min, cell, way;
    begin[across] = lines[n].begin;
    cell[along] = (region.box.max[along] - region.box.min[along]) / static_cast<double>(lines.size());
    cell[across] = lines[n].cell;
    way[along] = (static_cast<double>(n) + 0.5) * cell[along];
    way[across] = (static_cast<double>(k) + 0.5) * cell[across];
    const Vec X = begin + way;
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
    for (std::size_t n = 0; n < lines.size(); ++n)
      if (k < lines[n].count) place(n, k);
}

/// Whether regions a and b have more than an edge in common; of round ones, whether a particle of one lies
/// in the other.
bool overlap(const Parameters& parameters, const Body& body, std::size_t a, std::size_t b) {
  const Box &A = parameters.regions[a].box, &B = parameters.regions[b].box;
  if (A.is_rectangle() && B.is_rectangle()) {
    const double tolerance = 1e-6 * parameters.spacing;
    return std::any_of(body.shifts.begin(), body.shifts.end(), [&](const Vec& shift) {
      return ((A.max + shift - B.min).array() > tolerance).all() &&
             ((B.max - A.min - shift).array() > tolerance).all();
    });
  }
  for (const Vec& shift : body.shifts)
    for (std::size_t i = 0; i < body.size(); ++i)
      if ((body.region[i] == a && B.contains(body.X[i] + shift)) ||
          (body.region[i] == b && A.contains(body.X[i] - shift)))
        return true;
  return false;
}

void find_outlined_surface(Body& body) {
  Box bounds = body.outlines[0].bounds();
  for (const Outline& outline : body.outlines) {
    bounds.min = bounds.min.cwiseMin(outline.bounds().min);
    bounds.max = bounds.max.cwiseMax(outline.bounds().max);
  }
  const Vec margin = Vec::Constant(body.spacing);
  const auto pieces = body.surface({bounds.min - margin, bounds.max + margin});
  body.area_vector = area_vectors(body.X, pieces, furthest_particle * body.spacing);
  for (const SurfacePiece& piece : pieces)
    body.outside.push_back(piece.place + 0.5 * body.spacing * piece.area.normalized());
}

void check_load(const BoxLoad& load, const Body& body, double h, const TellFault& tell_fault) {
  if (load.pressure == 0) {
    if (body.inside(load.box).empty())
      tell_fault(item("load", load.name, load.shape.place()),
                 fmt::format("load '{}' acts on no particle of the solid", load.name));
    return;
  }
  const auto surface = body.surface(load.box);
  if (surface.empty())
    tell_fault(item("load", load.name, load.shape.place()),
               fmt::format("load '{}' acts on no surface of the solid", load.name));
  for (const SurfacePiece& piece : surface) try {
      MaterialPoint(piece.place, body.X, 2.0 * h, body.shape, body.shifts);
    } catch (const std::invalid_argument& error) {
      return tell_fault(item("load", load.name, load.shape.place()),
                        fmt::format("load '{}': {}", load.name, error.what()));
    }
}

void find_surface(Body& body) {
  body.area_vector.assign(body.size(), Vec::Zero());
  if (body.has_outline()) return find_outlined_surface(body);
  // Half a spacing and a little: where regions meet, their columns need not face each other.
  OccupancyIndex places(0.6 * body.spacing);
  places.take(with_images(body.X, body.shifts), "");
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

double Body::total_mass() const {
  std::vector<std::uint32_t> all(size());
  std::iota(all.begin(), all.end(), 0u);
  return mass_of(all);
}

double Body::mass_of(const std::vector<std::uint32_t>& particles) const {
  double sum = 0;
  for (std::size_t m = 0; m < density.size(); ++m) {
    double volume_of = 0;
    for (const auto i : particles)
      if (material[i] == m) volume_of += volume(i);
    sum += density[m] * volume_of;
  }
  return sum;
}

bool Body::contains(const Vec& x) const {
  return std::any_of(shifts.begin(), shifts.end(), [&](const Vec& shift) {
    return std::any_of(outlines.begin(), outlines.end(),
                       [&](const Outline& outline) { return outline.contains(x + shift); });
  });
}

std::optional<Outline::Foot> Body::foot(const Vec& x) const {
  std::optional<Outline::Foot> nearest;
  for (const Vec& shift : shifts)
    for (const Outline& outline : outlines) {
      auto found = outline.nearest(x + shift);
      found.place -= shift;
      const bool surface = !contains(found.place + beside * spacing * found.normal);
      if (surface && (!nearest || std::abs(found.distance) < std::abs(nearest->distance))) nearest = found;
    }
  return nearest;
}

std::vector<SurfacePiece> Body::surface(const Box& box) const {
  std::vector<SurfacePiece> found;
  for (const Outline& outline : outlines)
    for (const SurfacePiece& piece : surface_pieces(outline, longest_piece * spacing))
      if (box.contains(piece.place) && !contains(piece.place + beside * spacing * piece.area.normalized()))
        found.push_back(piece);
  return found;
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
  sites.take(with_images(outside, shifts), "");
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < size(); ++i)
    if (sites.taken(X[i])) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

void check_loads_and_observers(const Parameters& parameters, const Body& body, const TellFault& tell_fault) {
  for (const auto& load : parameters.loads) check_load(load, body, parameters.h(), tell_fault);
  for (const auto& observer : parameters.observers) try {
      MaterialPoint(observer.point, body.X, 2.0 * parameters.h(), body.shape, body.shifts);
    } catch (const std::invalid_argument& error) {
      tell_fault(item("observer", observer.name, "point"),
                 fmt::format("observer '{}': {}", observer.name, error.what()));
    }
}

Body build_body(const Parameters& parameters, const TellFault& tell_fault, const std::vector<Vec>& shifts) {
  Body body;
  body.shifts = shifts;
  body.spacing = parameters.spacing;
  const auto& regions = parameters.regions;
  std::vector<Box> boxes;
  boxes.reserve(regions.size());
  for (const auto& region : regions) boxes.push_back(region.box);
  check_size(boxes, parameters.spacing);
  std::vector<Box> holes;
  for (const auto& hole : parameters.holes) holes.push_back(hole.box);
  body.shape = Shape(with_images(boxes, shifts), with_images(holes, shifts), parameters.spacing);
  const bool has_outline =
      std::any_of(regions.begin(), regions.end(),
                  [&](const Region& region) { return is_fitted(region, parameters.holes); }) ||
      std::any_of(parameters.loads.begin(), parameters.loads.end(),
                  [](const BoxLoad& load) { return load.pressure != 0; });
  for (std::size_t a = 0; a < regions.size(); ++a) {
    const std::size_t before = body.size();
    if (has_outline) {
      auto outline = outline_without(regions[a], parameters.holes, tell_fault);
      if (!outline) continue;
      body.outlines.push_back(std::move(*outline));
    }
    if (is_fitted(regions[a], parameters.holes) && !regions[a].worn.empty())
      tell_fault(item("region", regions[a].name, regions[a].shape.place()),
                 fmt::format("region '{}' has 'worn' faces and a hole that is no box: it cannot have both",
                             regions[a].name));
    if (is_fitted(regions[a], parameters.holes))
      fit_region(a, body.outlines.back(), parameters, body, tell_fault);
    else
      fill_region(a, parameters, body, tell_fault);
    for (std::size_t b = 0; b < a; ++b)
      if (overlap(parameters, body, a, b))
        tell_fault(item("region", regions[a].name, regions[a].shape.place()),
                   fmt::format("region '{}' overlaps region '{}'; regions may touch only", regions[a].name,
                               regions[b].name));
    if (body.size() == before && !parameters.holes.empty() && !has_outline)
      tell_fault(item("region", regions[a].name, regions[a].shape.place()),
                 fmt::format("holes leave no particle of region '{}'", regions[a].name));
    body.counts.emplace_back("region " + regions[a].name, body.size() - before);
  }
  const auto of_region = parameters.materials_of_regions();
  for (const auto region : body.region) body.material.push_back(of_region[region]);
  for (const Material& material : parameters.all_materials())
    body.density.push_back(material.elastic.density);
  body.held.assign(body.size(), 0);
  for (const auto& clamp : parameters.clamps) {
    const auto particles = body.inside(clamp.box);
    if (particles.empty())
      tell_fault(item("clamp", clamp.name, clamp.shape.place()),
                 fmt::format("clamp '{}' holds no particle of the solid", clamp.name));
    for (const auto i : particles) body.held[i] = 1;
    body.counts.emplace_back("clamp " + clamp.name, particles.size());
  }
  if (body.size() > 0) find_surface(body);
  check_loads_and_observers(parameters, body, tell_fault);
  return body;
}

}  // namespace toryu::solid
