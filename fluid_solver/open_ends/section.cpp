#include "fluid_solver/open_ends/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fluid_solver/wall_rows.hpp"

namespace toryu::fluid {

namespace {

/// Terms of which nothing is known beyond the line.
template <class Term>
constexpr bool stays_inside =
    is_one_of<Term, EnclosedMedium, Viscoelasticity, CentralForce, ConsistentGradients>;

bool is_fluid(const Parameters& p, const Vec& x) {
  const auto contains = [&](const auto& body) { return static_cast<const Box&>(body).contains(x); };
  return std::any_of(p.regions.begin(), p.regions.end(),
                     [&](const Region& region) { return region.box.contains(x); }) &&
         std::none_of(p.holes.begin(), p.holes.end(), contains);
}

bool is_wall(const Scene& scene, const Vec& x) {
  return std::any_of(scene.walls.begin(), scene.walls.end(),
                     [&](const Wall& wall) { return wall.box.contains(x); });
}

/// Calls visit(place) in the middle of each spacing of `length`.
template <class Visit>
void over_rows(double length, double spacing, Visit&& visit) {
  const double rows = std::max(1.0, std::round(length / spacing));
  for (double k = 0.5; k < rows; ++k) visit(k * length / rows);
}

/// What is wrong with the places of a line and its layer, if anything.
std::optional<std::string> misplaced(const OpenEnd& end, const Parameters& p, const Scene& scene) {
  const auto section = section_of(end, p);
  if (!section)
    return "the line has fluid on neither side or on both: a [[fluid.region]] ends at it, and nothing of the "
           "fluid lies beyond";
  const double d = p.spacing;
  std::optional<std::string> found;
  const auto require = [&](bool holds, const char* what, const Vec& x) {
    if (!holds && !found) found = fmt::format("{} near ({:.6g}, {:.6g}) m", what, x[0], x[1]);
  };
  over_rows(section->length, d, [&](double place) {
    const Vec before = section->point(place, 0.5 * d);
    require(!is_wall(scene, before), "the line runs into a wall", before);
    require(is_fluid(p, before), "there is no fluid before the line", before);
    over_rows(section->depth, d, [&](double beyond) {
      const Vec x = section->point(place, -beyond);
      require(!is_wall(scene, x), "a wall stands beyond the line, where the fluid goes on,", x);
      require(!is_fluid(p, x), "the fluid's own region goes on beyond the line", x);
    });
  });
  over_rows(section->depth, d, [&](double beyond) {
    for (const double place : {-0.5 * d, section->length + 0.5 * d}) {
      const Vec x = section->point(place, -beyond);
      require(is_wall(scene, x),
              "the line must go from wall to wall, and the walls on beyond it: there is none", x);
    }
  });
  if (found)
    *found += fmt::format(" (the layer beyond the line of an open end is {:.6g} m deep, here to {} = {:.6g})",
                          section->depth, section->inward[0] != 0 ? 'x' : 'y',
                          section->point(0, -section->depth)[section->inward[0] != 0 ? 0 : 1]);
  const double room = section->depth;
  if (!found)
    over_rows(room, d, [&](double distance) {
      const Vec x = section->point(0.5 * section->length, distance);
      if (!is_fluid(p, x) && !is_wall(scene, x) && !found)
        found = fmt::format(
            "the fluid ends {:.6g} m before the line, which is less than the layer beyond it is "
            "deep, {:.6g} m: take a longer channel or a finer spacing",
            distance, room);
    });
  return found;
}

template <class Visit>
void for_each_end(const Parameters& p, Visit&& visit) {
  for (std::size_t k = 0; k < p.inlets.size(); ++k) visit(fmt::format("fluid.inlet.{}", k), p.inlets[k]);
  for (std::size_t k = 0; k < p.outlets.size(); ++k) visit(fmt::format("fluid.outlet.{}", k), p.outlets[k]);
}

}  // namespace

Box Section::layer() const {
  const Vec a = point(0, -depth), b = point(length, 0);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

double layer_depth(const Parameters& p) {
  const double reach = (1 + p.neighbour_skin) * 2 * p.h();
  return p.spacing * std::ceil(2 * reach / p.spacing);
}

std::optional<Section> section_of(const OpenEnd& end, const Parameters& p) {
  Section section{.origin = end.from, .length = (end.to - end.from).norm(), .depth = layer_depth(p)};
  section.along = (end.to - end.from) / section.length;
  section.inward = {-section.along[1], section.along[0]};
  std::array<double, 2> rows{};  // with fluid, on either side
  for (const int side : {0, 1}) {
    over_rows(section.length, p.spacing, [&](double place) {
      rows[static_cast<std::size_t>(side)] += is_fluid(p, section.point(place, 0.5 * p.spacing)) ? 1 : 0;
    });
    section.inward *= -1;
  }
  if ((rows[0] > 0) == (rows[1] > 0)) return {};
  if (rows[0] == 0) section.inward *= -1;
  return section;
}

std::vector<Section> sections_of(const Parameters& p) {
  std::vector<Section> sections;
  for_each_end(p, [&](const std::string&, const OpenEnd& end) {
    if (const auto section = section_of(end, p)) sections.push_back(*section);
  });
  return sections;
}

Parameters with_layers(Parameters p) {
  std::vector<Region> layers;
  for (const Section& section : sections_of(p))
    layers.push_back({.name = "beyond an open end", .box = section.layer()});
  p.regions.insert(p.regions.end(), layers.begin(), layers.end());
  return p;
}

std::vector<StartFault> open_end_faults(const Parameters& p, const Scene& scene) {
  std::vector<StartFault> faults;
  if (!p.has_open_ends()) return faults;
  const std::string key = p.inlets.empty() ? "fluid.outlet" : "fluid.inlet";
  const auto refuse = [&](bool is_there, const std::string& what) {
    if (is_there) faults.push_back({key, fmt::format("channels with open ends do not go with {}", what)});
  };
  refuse(p.model == Model::implicit, "model = \"implicit\"");
  refuse(scene.geometry != Geometry::plane, "[case] geometry = \"axisymmetric\"");
  refuse(scene.periodic != Periodic::none, "space that repeats itself ([case] periodic)");
  refuse(p.similarity.has_value(), "[fluid.similarity]");
  for_each_term(p, [&]<class Term>(const std::optional<Term>& term) {
    refuse(stays_inside<Term> && term, fmt::format("[fluid.{}]", Term::section));
  });
  if (!faults.empty()) return faults;
  for_each_end(p, [&](const std::string& of_end, const OpenEnd& end) {
    if (const auto fault = misplaced(end, p, scene))
      faults.push_back({of_end, fmt::format("open end '{}': {}", end.name, *fault)});
  });
  return faults;
}

}  // namespace toryu::fluid
