/// How the fluid beside the elastic solid's interface answers its motion: the impedance that a coupling
/// scheme may hand the solid, and the impulse that comes back for it. Over ranks either is known on rank 0.
#pragma once

#include <vector>

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// The impedance of each particle of the interface, the last of the boundaries, by id, dim values [kg/(s.m)]:
///
///     rho_0 c_0 a_i,   a_i = 2 V_i sum_j V_j gradW_ij
///
/// with the sum over the fluid. a_i is the area that i bears, outward: a uniform pressure p presses with
/// -p a_i, and over a plane face the a_i of all rows in reach sum up to its area. A change dv of the normal
/// speed sends a wave of pressure rho_0 c_0 dv into the fluid (Joukowsky 1898), which holds until echoes
/// come.
std::vector<double> impedance(const std::vector<Boundary>& boundaries, const Particles& fluid,
                              const Kernel& kernel, double rest_density, double sound_speed,
                              const Ranks* ranks = nullptr);

/// What giving an impulse did.
struct GivenImpulse {
  Vec received = Vec::Zero();     ///< by the fluid, all in all [N s/m]
  double work = 0;                ///< that it did to the fluid [J/m]
  std::vector<double> not_given;  ///< by id, where no fluid was in reach; as `impulse` was given [N s/m]
};

/// Takes `impulse` (by id, dim values a particle of the interface, the last of `boundaries` [N s/m]) out of
/// the fluid: the share of j in reach of i is m_j W_ij/sum_k m_k W_ik, so that sums agree to rounding.
GivenImpulse give_impulse(const std::vector<double>& impulse, const std::vector<Boundary>& boundaries,
                          Particles& fluid, const Kernel& kernel, const Ranks* ranks = nullptr);

}  // namespace toryu::fluid
