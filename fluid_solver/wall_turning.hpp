/// What a wall that turns sees of the fluid: the velocity against it, and what its turning adds to what its
/// particles take from the fluid.
#pragma once

#include "common/sph/neighbour_loop.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// A sum of kernel values below this share of W(0) means that no fluid is in reach.
constexpr double smallest_share = 1e-9;

inline VecLanes product(const Mat& M, const VecLanes& v) {
  return {M(0, 0) * v[0] + M(0, 1) * v[1], M(1, 0) * v[0] + M(1, 1) * v[1]};
}

/// What a wall that turns by omega adds: there all is as seen by the wall, at rest. Its particles mirror what
/// the fluid has beyond the wall's turning, and its acceleration changes with the place,
///
///     v_w-f += omega x (x~ - x_w),   p_w -= omega^2/2 sum_i rho_i |x_wi|^2 W_wi/sum_i W_wi,
///
/// x~ the mean place of the fluid in reach: fluid that turns with the wall feels neither stress nor a step of
/// the pressure.
template <class W>
void turn_cluster(Boundary& boundary, const Particles& fluid, const W& kernel, std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  Lanes sum_W = 0.0, sum_rho_r2 = 0.0;
  VecLanes sum_x = zero_vector();
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes W_wi = kernel.value(n.r);
                    sum_W += W_wi;
                    sum_rho_r2 += fluid.rho[i] * W_wi * n.r * n.r;
                    add_product(sum_x, W_wi, n.x_ij);
                  });
  const double omega = boundary.angular_velocity;
  const Lanes share = inverse(max(sum_W, smallest_share * kernel.value(0.0)));
  store(load(boundary.v_viscous[0], first) + omega * share * sum_x[1], boundary.v_viscous[0], first);
  store(load(boundary.v_viscous[1], first) - omega * share * sum_x[0], boundary.v_viscous[1], first);
  const Lanes p_w = load(boundary.p, first) - 0.5 * omega * omega * share * sum_rho_r2,
              inverse_rho = inverse(load(boundary.rho, first));
  store(p_w, boundary.p, first);
  store(p_w * inverse_rho * inverse_rho, boundary.p_rho2, first);
}

/// The integral of r . n over what of a wall's surface the fluid wets, r from the wall's pivot and n out of
/// the wall: 2 sum_w sum_i V_w V_i r_wi . gradW_wi, r_wi in the middle of both [m2]. Twice the area of a wall
/// within the fluid, minus that of a fluid within walls.
///
/// The pair forces of a laminar viscosity are those of the stress mu grad v, which leaves out mu (grad v)^T.
/// Within the fluid the latter makes no force, but on a wall that turns by omega, to which the fluid sticks,
/// its moment on the fluid is mu omega times this integral, and so much by omega is dissipated beyond what
/// the pairs take: without it a fluid that turns rigidly with its tank would need a moment and heat up.
/// Of boundary `b` of a part of a fluid over `ranks` rank 0 finds that of the whole.
double wetted_surface_moment(const Boundary& boundary, const Particles& fluid, const Kernel& kernel,
                             std::size_t b, const Ranks* ranks);

/// The velocity of particle i of the fluid against the wall, which may turn, at a place of the wall x_w - x_i
/// from it.
TORYU_INLINE VecLanes against_wall(const Boundary& boundary, const VecLanes& v_w, const Particles& fluid,
                                   std::uint32_t i, const VecLanes& x_wi) {
  const double omega = boundary.angular_velocity;
  const VecLanes v = difference(v_w, pointers(fluid.v), i);
  return {-v[0] - omega * x_wi[1], -v[1] + omega * x_wi[0]};
}

}  // namespace toryu::fluid
