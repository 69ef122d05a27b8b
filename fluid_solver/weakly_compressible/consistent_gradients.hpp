/// Divergence of the velocity and gradient of the pressure that are exact in linear fields however the
/// particles lie (Randles & Libersky 1996),
///
///     <div v>_i = sum_j V_j (v_j - v_i) . L_i gradW_ij,   <grad p>_i = sum_j V_j (p_j - p_i) L_i gradW_ij,
///
/// and, in a Newtonian medium, the viscous force of a velocity of the second order (Schwaiger 2008), k_ij =
/// 2 mu m_j/(rho_i rho_j) x_ij . gradW_ij/r_ij^2 as in terms/laminar_viscosity.hpp, M_i the moment L_i^-1:
///
///     2/tr M_i [sum_j k_ij v_ij - <grad v>_i . sum_j k_ij x_ij]
///
/// in place of the sums of (18) and (22) and of k_ij v_ij, which are off by as much as the moment of the
/// neighbours differs from the unit matrix: a few per cent where a flow strains its particles, and always to
/// the same side. They stand where there is neither a wall nor a free surface in reach. Differences of
/// pressure do not drive particles apart, so they need particle shifting; and they keep momentum only as far
/// as they converge.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/weakly_compressible/pair_sweeps.hpp"

namespace toryu::fluid {

/// Puts them into the wanted rates a, drho of `fluid`, which hold (18) and (22). Needs
/// `fluid.off_surface_and_walls`. `mu` [Pa s] is the viscosity of a Newtonian medium, else 0. Of `some`
/// clusters alone, if they are given.
void make_gradients_consistent(RatesOf wanted, double mu, Particles& fluid, const ClusterList& neighbours,
                               const Kernel& kernel, const std::vector<std::uint32_t>* some = nullptr);

}  // namespace toryu::fluid
