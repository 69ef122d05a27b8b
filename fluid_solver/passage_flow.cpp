#include "fluid_solver/passage_flow.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

namespace {

/// Of the medium and its polymer [Pa s].
double steady_viscosity(const OptionalTerms& terms, double gdot) {
  double eta = viscosity_of(terms, gdot);
  if (terms.viscoelasticity)
    for (const PolymerMode& mode : terms.viscoelasticity->modes) eta += steady_viscosity(mode, gdot);
  return eta;
}

double slip_under(const OptionalTerms& terms, double tau_w) {
  return terms.wall_slip ? slip_speed(*terms.wall_slip, tau_w) : 0.0;
}

/// U over w of the flow with that shear rate at the wall [1/s].
double speed_over_width(const OptionalTerms& terms, double gdot_w, Geometry geometry) {
  constexpr int intervals = 2000;
  const double tau_w = steady_viscosity(terms, gdot_w) * gdot_w;
  double sum = 0;  // by the midpoint rule
  for (int k = 0; k < intervals; ++k) {
    const double gdot = (k + 0.5) / intervals * gdot_w, share = steady_viscosity(terms, gdot) * gdot / tau_w;
    sum += geometry == Geometry::plane ? share * share : share * share * share;
  }
  return (geometry == Geometry::plane ? 1 / 4.0 : 1 / 6.0) * gdot_w * (1 - sum / intervals);
}

/// The shear rate beyond which it is no longer `below` [1/s].
template <class Below>
double shear_rate_where(Below&& below) {
  double low = 1e-100, high = 1e100;
  while (high / low > 1 + 1e-12) {
    const double gdot = std::sqrt(low) * std::sqrt(high);
    (below(gdot) ? low : high) = gdot;
  }
  return low;
}

}  // namespace

PassageFlow passage_flow(const OptionalTerms& terms, double mean_speed, double width, Geometry geometry) {
  const double gdot_w = shear_rate_where([&](double gdot) {
    return slip_under(terms, steady_viscosity(terms, gdot) * gdot) +
               speed_over_width(terms, gdot, geometry) * width <
           mean_speed;
  });
  const double eta_w = steady_viscosity(terms, gdot_w), tau_w = eta_w * gdot_w;
  return {.wall_shear_rate = gdot_w,
          .wall_viscosity = eta_w,
          .wall_stress = tau_w,
          .slip_speed = slip_under(terms, tau_w)};
}

double mean_speed(const OptionalTerms& terms, double wall_stress, double width, Geometry geometry) {
  const double gdot_w =
      shear_rate_where([&](double gdot) { return steady_viscosity(terms, gdot) * gdot < wall_stress; });
  return slip_under(terms, wall_stress) + speed_over_width(terms, gdot_w, geometry) * width;
}

Vec sides(const std::vector<Region>& regions) {
  Vec least = regions.front().box.min, most = regions.front().box.max;
  for (const Region& region : regions)
    least = least.cwiseMin(region.box.min), most = most.cwiseMax(region.box.max);
  return most - least;
}

double passage_width(const std::vector<Region>& regions, Geometry geometry) {
  const Vec box = sides(regions);
  return geometry == Geometry::plane ? box.minCoeff() : std::min(box[0], 2 * box[1]);
}

}  // namespace toryu::fluid
