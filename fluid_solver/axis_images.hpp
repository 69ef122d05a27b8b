/// The axis of an axisymmetric case: images of all particles mirrored at it, which pair loops meet as any
/// other source. The image of particle k is number `padded(count)` + k of the same fields, so that no loop
/// knows of images but for the lists of neighbours (ClusterList::build) that lead to them.
#pragma once

#include <cmath>

#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

/// Room that the fields of `count` particles take.
inline std::size_t room_of(std::size_t count, Geometry geometry) {
  return (geometry == Geometry::axisymmetric ? 2 : 1) * padded(count);
}

/// Refreshes the images of a field that is there; `sign` -1 of what changes its sign by mirroring.
inline void mirror(Field& field, double sign = 1) {
  const std::size_t half = field.size() / 2;
  for (std::size_t k = 0; k < half; ++k) field[half + k] = sign * field[k];
}
inline void mirror(VecField& vector) {
  mirror(vector[0]);
  mirror(vector[1], -1);
}
inline void mirror(TensorField& tensor) {
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b) mirror(tensor[a][b], a == b ? 1 : -1);
}

/// Of all that is known before walls take anything from the fluid.
template <class Body>
void mirror_body(Body& body) {
  mirror(body.x);
  mirror(body.v);
  for (Field* field :
       {static_cast<Field*>(&body.m), static_cast<Field*>(&body.V), static_cast<Field*>(&body.rho),
        static_cast<Field*>(&body.p), static_cast<Field*>(&body.p_rho2)})
    mirror(*field);
}
inline void mirror_bodies(Particles& fluid, std::vector<Boundary>& boundaries) {
  mirror_body(fluid);
  for (Boundary& boundary : boundaries) mirror_body(boundary);
}
/// Of what a wall takes from the fluid.
inline void mirror_extrapolated(Boundary& boundary) {
  mirror(boundary.p);
  mirror(boundary.p_rho2);
  mirror(boundary.v_viscous);
}
/// Of what the viscosity is made of.
template <class Body>
void mirror_viscosity(Body& body) {
  mirror(body.eta);
  mirror(body.eta_grad_v);
}

/// Puts back what has come beyond the axis, as what comes from there by symmetry.
inline void keep_off_axis(Particles& fluid) {
  for (std::size_t i = 0; i < fluid.count; ++i)
    if (fluid.x[1][i] < 0) {
      fluid.x[1][i] = -fluid.x[1][i];
      fluid.v[1][i] = -fluid.v[1][i];
    }
}

}  // namespace toryu::fluid
