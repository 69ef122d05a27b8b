/// Developed flow of a medium between two plates (Bird, Armstrong & Hassager 1987, section 4.2): tau = tau_w
/// at the wall and falls linearly to the middle, so that, by parts, the mean speed is
///
///     U = u_s + w/4 [gdot_w - integral_0^gdot_w (tau(gdot)/tau_w)^2 dgdot],
///
/// u_s the slip of [fluid.wall_slip] under tau_w, else 0. In a tube of the diameter w likewise
///
///     U = u_s + w/6 [gdot_w - integral_0^gdot_w (tau(gdot)/tau_w)^3 dgdot].
///
/// A polymer adds its viscosity in steady shear.
#pragma once

#include <vector>

#include "common/scene/scene.hpp"
#include "fluid_solver/terms.hpp"

namespace toryu::fluid {

struct Region;

struct PassageFlow {
  double wall_shear_rate = 0;  ///< [1/s]
  double wall_viscosity = 0;   ///< [Pa s]
  double wall_stress = 0;      ///< [Pa]
  double slip_speed = 0;       ///< u_s [m/s]
};
/// Of the medium of `terms` at the mean speed U [m/s] between plates `width` [m] apart, or about an axis in a
/// tube of that diameter.
PassageFlow passage_flow(const OptionalTerms& terms, double mean_speed, double width,
                         Geometry geometry = Geometry::plane);

/// U [m/s] under that shear stress of the walls [Pa].
double mean_speed(const OptionalTerms& terms, double wall_stress, double width,
                  Geometry geometry = Geometry::plane);

/// Of the box about all of the fluid [m].
Vec sides(const std::vector<Region>& regions);
/// The shorter side; about an axis the fluid reaches as far beyond it [m].
double passage_width(const std::vector<Region>& regions, Geometry geometry);

}  // namespace toryu::fluid
