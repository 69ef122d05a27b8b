/// The area over which an enclosed medium meets a wall that is pressed: the force along its press, by the
/// sums over pairs, of a medium at 1 Pa everywhere,
///
///     A_k = sum_w m_w sum_f m_f (1/(rho_f^2 c_f) + 1/(rho_w^2 c_w)) dW_wf/dn,   c = 2 pi r about an axis,
///     else 1
///
/// It is that of the face but for the corners, where particles of the walls beside the piston bear a share:
/// of pairs whose separation is (s_x, s_y) as many lie across a corner as an area s_x s_y holds, so that each
/// corner takes
///
///     2 int_0^inf int_0^inf s_x s_y |dW/dx| ds_x ds_y = <s>/pi,   <s> = int s W dV
///
/// h 2/(3 pi) for Wendland's C2, h 5/(7 pi) for the cubic spline, and as sums over a lattice 0.392 d_0
/// (Wendland C2, h/d_0 = 2), 0.228 and 0.306 d_0 (cubic spline, 1.25 and 1.5): of a face of 10 particles
/// between two walls 7.9, 4.5 and 5.4 %. By the face's own area the medium would be held at a pressure that
/// is as much too high.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// [m], about an axis [m2], of `piston`, which is pressed and is boundary `b`. Over ranks, of the whole fluid
/// on rank 0.
double met_area(const Boundary& piston, const Particles& fluid, const Kernel& kernel,
                Geometry geometry = Geometry::plane, std::size_t b = 0, const Ranks* ranks = nullptr);

/// Throws PhysicsFailure where the medium `met` the piston [m; about an axis m2] over an area that is not
/// near that of its face: it is on both sides, on the other, or gone.
void require_medium_before_face(const Boundary& piston, double met);

}  // namespace toryu::fluid
