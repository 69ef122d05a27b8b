#include "solid_solver/stability_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error/counted.hpp"

namespace toryu::solid {

namespace {

/// Artificial stress above this feeds the sliding of rows more than viscosity stops it.
constexpr double most_epsilon = 0.5;

void guard_artificial_stress(const Parameters& p, std::vector<std::string>& said) {
  const double epsilon = p.artificial_stress ? p.artificial_stress->epsilon : 0.0;
  const int exponent = p.artificial_stress ? p.artificial_stress->exponent : 4;
  const double least = least_epsilon(p.smoothing_ratio, exponent);
  if (epsilon < least)
    said.push_back(
        fmt::format("artificial stress of epsilon {:g} is below the {:.2g} that keeps a stretched body from "
                    "tearing by itself; see cases/stretched_bar/tensile_map.toml",
                    epsilon, least));
  if (epsilon > most_epsilon)
    said.push_back(
        fmt::format("artificial stress of epsilon {:g} is above the {:g} from which particles under tension "
                    "slide into another arrangement; see cases/stretched_bar/tensile_window_map.toml",
                    epsilon, most_epsilon));
}

/// Length along `axis` of the solid on the line through the middle of `region`: what touches it is one with
/// it [m].
double thickness(const Parameters& p, const Region& region, int axis) {
  const int across = 1 - axis;
  const double middle = 0.5 * (region.box.min[across] + region.box.max[across]), rounding = 1e-6 * p.spacing;
  double low = region.box.min[axis], high = region.box.max[axis];
  for (bool grows = true; grows;) {
    grows = false;
    for (const Region& other : p.regions) {
      const Box& box = other.box;
      const bool touches = box.is_rectangle() && box.min[across] <= middle && box.max[across] > middle &&
                           box.min[axis] <= high + rounding && box.max[axis] >= low - rounding;
      if (!touches || (box.min[axis] >= low && box.max[axis] <= high)) continue;
      low = std::min(low, box.min[axis]);
      high = std::max(high, box.max[axis]);
      grows = true;
    }
  }
  return high - low;
}

/// Rows of the solid where it is thinnest and no clamp holds a region as a whole; round regions have none.
double fewest_rows(const Parameters& p) {
  double fewest = std::numeric_limits<double>::infinity();
  for (const auto& region : p.regions) {
    const bool held = std::any_of(p.clamps.begin(), p.clamps.end(), [&](const Clamp& clamp) {
      return (clamp.box.min.array() <= region.box.min.array()).all() &&
             (clamp.box.max.array() >= region.box.max.array()).all();
    });
    if (!held && region.box.is_rectangle())
      fewest = std::min({fewest, thickness(p, region, 0) / p.spacing, thickness(p, region, 1) / p.spacing});
  }
  return std::round(fewest);
}

void guard_thin_plates(const Parameters& p, std::vector<std::string>& said) {
  const double rows = fewest_rows(p);
  double nu = -1;
  const auto all = p.all_materials();
  for (const auto index : p.materials_of_regions()) nu = std::max(nu, all[index].elastic.poissons_ratio);
  if (rows < (p.hourglass ? 3 : 12))
    said.push_back(
        fmt::format("a plate of {}{} bends by 6 % too little or too much, or more; see "
                    "cases/oscillating_plate/thin_map.toml",
                    counted(rows, "row"), p.hourglass ? "" : " without [solid.hourglass]"));
  if (rows < 5 && nu > 0.48)
    said.push_back(
        fmt::format("a plate of {} with Poisson's ratio {:g} is too stiff, as its volume can hardly "
                    "change; see cases/oscillating_plate/poisson_map.toml",
                    counted(rows, "row"), nu));
}

/// Distance of two boxes [m], 0 where they touch.
double distance(const Box& a, const Box& b) {
  return (b.min - a.max).cwiseMax(a.min - b.max).cwiseMax(0.0).norm();
}

void guard_close_bodies(const Parameters& p, std::vector<std::string>& said) {
  for (std::size_t a = 0; a < p.regions.size() && !p.body_contact; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double gap = distance(p.regions[a].box, p.regions[b].box);
      if (gap > 1e-6 * p.spacing && gap < p.spacing)
        said.push_back(fmt::format(
            "regions '{}' and '{}' stand {:.3g} m apart, {:.2g} spacings: no material joins them there, "
            "and without [solid.body_contact] they pass through each other",
            p.regions[b].name, p.regions[a].name, gap, gap / p.spacing));
    }
}

}  // namespace

double courant_edge(const Parameters& p) {
  if (p.integrator == Integrator::symplectic) return 1.84;
  return p.artificial_viscosity ? 1.1 * std::cbrt(p.artificial_viscosity->alpha) : 0.0;
}

StressEdges stress_edges(const Parameters& p) {
  if (p.formulation == Formulation::total_lagrangian) return {};
  StressEdges edges{.strain = 0.30, .rearranged = 0.1};
  if (p.gradients == Gradients::plain) edges.turn = 0.2;
  return edges;
}

std::vector<std::string> stability_warnings(const Parameters& p) {
  std::vector<std::string> said;
  if (p.formulation == Formulation::rigid) return said;
  if (p.formulation == Formulation::total_lagrangian) {
    guard_thin_plates(p, said);
    guard_close_bodies(p, said);
    return said;
  }
  guard_artificial_stress(p, said);
  const double edge = courant_edge(p), courant = p.time_step_share * p.courant_number;
  if (edge == 0 && !p.damping)
    said.push_back(fmt::format(
        "nothing damps the solid, and midpoint steps amplify what is not damped by (omega dt)^4/8 each: give "
        "it [solid.artificial_viscosity] or integrator = \"symplectic\"; see "
        "cases/oscillating_plate/time_step_map.toml"));
  else if (courant > edge && !p.damping)
    said.push_back(
        fmt::format("courant_number times time_step_share is {:.3g}, beyond the edge of stability at {:.3g}; "
                    "see cases/oscillating_plate/time_step_map.toml",
                    courant, edge));
  return said;
}

}  // namespace toryu::solid
