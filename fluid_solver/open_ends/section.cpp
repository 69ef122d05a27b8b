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

constexpr const char* no_side =
    "the line has fluid on neither side or on both: a [[fluid.region]] must end at it, and nothing of the "
    "fluid lie beyond";

/// Over the sound speed: of a larger change at once the density changes by more than 1 %.
constexpr double largest_start = 0.01;

bool lies_along_an_axis(const OpenEnd& end) {
  const Vec length = end.to - end.from;
  return (length[0] == 0) != (length[1] == 0);
}

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

bool is_solid(const std::vector<Part>& solid, const Vec& x) {
  const auto contains = [&](const Box& box) { return box.contains(x); };
  return std::any_of(solid.begin(), solid.end(), [&](const Part& part) {
    return std::all_of(part.within.begin(), part.within.end(), contains) &&
           std::none_of(part.without.begin(), part.without.end(), contains);
  });
}

/// Of an open end: each is looked at.
constexpr double most_rows = 1e6;

/// Calls visit(place) in the middle of each spacing of `length`.
template <class Visit>
void over_rows(double length, double spacing, Visit&& visit) {
  const double rows = std::max(1.0, std::round(length / spacing));
  for (double k = 0.5; k < rows; ++k) visit(k * length / rows);
}

/// What is wrong with the places about a line, if anything.
class Places {
 public:
  Places(const Section& section, const Parameters& p, const Scene& scene, const std::vector<Part>& solid)
      : section_(section), p_(p), scene_(scene), solid_(solid) {}

  std::optional<std::string> fault() {
    over_rows(section_.length, p_.spacing, [&](double place) { look_across(place); });
    over_rows(section_.depth, p_.spacing, [&](double beyond) {
      for (const double place : {-0.5 * p_.spacing, section_.length + 0.5 * p_.spacing})
        require(is_wall(scene_, section_.point(place, -beyond)),
                "the line must go from wall to wall, and the walls on beyond it: there is none",
                section_.point(place, -beyond));
    });
    over_rows(section_.depth, p_.spacing, [&](double before) {
      const Vec x = section_.point(0.5 * section_.length, before);
      require(is_fluid(p_, x) || is_wall(scene_, x),
              "the channel must be longer than the layer beyond the line is deep: it ends", x);
    });
    if (found_)
      *found_ += fmt::format("; the layer beyond the line is {:.6g} m deep, to {} = {:.6g} m", section_.depth,
                             "xy"[axis()], section_.point(0, -section_.depth)[axis()]);
    return found_;
  }

 private:
  int axis() const { return section_.inward[0] != 0 ? 0 : 1; }
  void require(bool holds, const char* what, const Vec& x) {
    if (!holds && !found_) found_ = fmt::format("{} near ({:.6g}, {:.6g}) m", what, x[0], x[1]);
  }
  void look_across(double place) {
    const Vec before = section_.point(place, 0.5 * p_.spacing);
    require(!is_wall(scene_, before), "the line runs into a wall", before);
    require(is_fluid(p_, before), "there is no fluid before the line", before);
    over_rows(section_.depth, p_.spacing, [&](double beyond) {
      const Vec x = section_.point(place, -beyond);
      require(!is_wall(scene_, x), "a wall stands beyond the line, where the fluid goes on,", x);
      require(!is_solid(solid_, x), "the solid lies beyond the line, where the fluid goes on,", x);
    });
  }

  const Section& section_;
  const Parameters& p_;
  const Scene& scene_;
  const std::vector<Part>& solid_;
  std::optional<std::string> found_ = {};
};

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
  if (!lies_along_an_axis(end)) return {};
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

std::vector<std::string> abrupt_inlets(const Parameters& p) {
  std::vector<std::string> said;
  for (const Inlet& inlet : p.inlets) {
    const auto section = section_of(inlet, p);
    if (!section) continue;
    const Vec before = section->point(0.5 * section->length, 0.5 * p.spacing);
    double speed = 0;
    for (const Region& region : p.regions)
      if (region.box.contains(before)) speed = section->inward.dot(region.velocity);
    const double blow = inlet.mean_at(0) - speed;
    if (std::abs(blow) <= largest_start * p.sound_speed) continue;
    said.push_back(fmt::format(
        "the inlet '{}' begins at once with a mean of {:.3g} m/s, and the fluid before it starts with {:.3g} "
        "m/s: a blow of rho c times the difference, {:.3g} Pa, runs through the channel; give it a "
        "'ramp_time' of some passages of sound",
        inlet.name, inlet.mean_at(0), speed, p.density * p.sound_speed * std::abs(blow)));
  }
  return said;
}

std::vector<StartFault> open_end_faults(const Parameters& p, const Scene& scene,
                                        const std::vector<Part>& solid) {
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
  for_each_end(p, [&](const std::string& key_of_end, const OpenEnd& end) {
    if (!lies_along_an_axis(end)) return;  // which has been told
    const double rows = (end.to - end.from).norm() / p.spacing;
    if (!(rows <= most_rows)) {
      faults.push_back(
          {key_of_end, fmt::format("open end '{}': the spacing of {:g} m gives it {:.1e} rows; at "
                                   "most {:.0e} are possible",
                                   end.name, p.spacing, rows, most_rows)});
      return;
    }
    const auto section = section_of(end, p);
    const auto fault = section ? Places(*section, p, scene, solid).fault() : std::string(no_side);
    if (fault) faults.push_back({key_of_end, fmt::format("open end '{}': {}", end.name, *fault)});
  });
  return faults;
}

}  // namespace toryu::fluid
