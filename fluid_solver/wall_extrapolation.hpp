/// What the particles of a wall take from the fluid near them.
///
/// Kernel means (Adami, Hu & Adams 2012; thesis eq. 27-29): of the pressure, with the weight of what lies
/// between; of the velocity v~_w, for the viscous terms v_w-f = 2 v_w - v~_w; of viscosity and eta grad v
/// where the medium is not Newtonian. A mean stands for a place nearer to or farther from the face than the
/// wall particle lies behind it, so the row beside the wall comes out 5 to 15 % too fast, at any spacing.
///
/// Fits, where the case asks for them and the boundary knows its faces: with d_i the distance of particle i
/// of the fluid from the face and d_w that of the wall particle behind it, weighted by W_wi,
///
///     v_i - v_w = g d_i + c d_i^2,   v_w-f = v_w - g d_w + c d_w^2;   ln eta and eta grad v as lines in d_i
///
/// (Morris, Fox & Zhu 1997 take v_w-f = v_w - (v_i - v_w) d_w/d_i pair by pair, which is the line alone: in a
/// slit of 10 particles its error is that of the mean, the parabola's a fourth). Where the outline is round,
/// d_i is the distance from the circle that touches it: from the tangent, fluid to the side would be too near
/// by up to t^2/(2 R), and the first row behind a wall 12 particles across would mirror a shear a sixth too
/// large. Among the faces of a particle it is the one that most separates it from the mean place of the
/// fluid; where none does, as behind an inner corner, the means stand.
///
/// Where the medium slides along the wall (terms/wall_slip.hpp), v_w + u_s stands for v_w in either: a fit of
/// v_i - v_w - u_s, or 2 (v_w + u_s) - v~_w. The rate of shear at the wall, g of the fit or the mean's over
/// the mean distance of the fluid from the face, is linear in u_s along the face. Where no face is found the
/// medium sticks.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/terms.hpp"

namespace toryu::fluid {

/// Extrapolates pressure (29) and velocity (27) from the fluid to the particles of `boundary` near it.
void extrapolate(Boundary& boundary, const Particles& fluid, const Kernel& kernel, const Vec& gravity);

/// After `extrapolate`: lets the medium slide along the particles of `boundary`, which knows its faces, by
/// `terms.wall_slip`; with friction a work piece bears mu_A (p + p_offset [Pa]) at most.
void let_slide(Boundary& boundary, const Particles& fluid, const Kernel& kernel, const OptionalTerms& terms,
               double p_offset);

/// Extrapolates the stress of a viscoelastic medium's polymer: as a mean, or as a line where the velocity is
/// fitted.
void extrapolate_polymer_stress(Boundary& boundary, const Particles& fluid, const Kernel& kernel);

/// Extrapolates viscosity and eta grad v of a medium that is not Newtonian likewise.
void extrapolate_viscosity(Boundary& boundary, const Particles& fluid, const Kernel& kernel);

}  // namespace toryu::fluid
