/// A medium that walls enclose on all sides keeps its volume, sum_i m_i/rho_i, whatever moves in it. The
/// density that follows the flow pair by pair does not know that: over 50,000 steps of a lid-driven cavity
/// what shifting, walls and steps leave adds up to half a percent to two, one way. At a hundredth of Mach
/// number squared that is a pressure above all others: the medium is under suction everywhere, tears, and
/// sinks into its walls. So after each step
///
///     rho_i <- rho_i sum_j V_j/(sum_j V_j at the start),
///
/// the same share for all, some 1e-7, which changes the level of the pressure and no difference of it beyond
/// that share.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// sum_i m_i/rho_i of the whole fluid, to the last bit the same over any number of ranks [m2; about an axis
/// m3].
double volume(const Particles& fluid, const Ranks* ranks = nullptr);

/// Gives the fluid the volume `held` [as above].
void hold_volume(Particles& fluid, double held, const Ranks* ranks = nullptr);

/// Mean of sum_j V_j W_ij with V = m/rho_0 over the fluid, walls included: 1 where particles stand as at the
/// start, more where walls have left them less room, whatever their density. Of a part of a fluid over
/// `ranks` that of the whole, on rank 0.
double packing(const Particles& fluid, const ClusterList& of_fluid, const std::vector<Boundary>& boundaries,
               const Kernel& kernel, double rho_0, const Ranks* ranks = nullptr);

}  // namespace toryu::fluid
