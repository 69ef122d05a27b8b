/// Axisymmetric flow: particles are rings about the axis, x along it and y = r the distance from it. A ring
/// has the mass m = 2 pi r rho A of its whole circumference, and V of the loops is A.
///
/// Each sum over pairs is that of the plane with weights that make it the one about an axis. The hoop parts,
/// which stand beside the sums in the literature (Petschek & Libersky 1993, Brookshaw 2003, Garcia-Senz,
/// Relano, Cabezon & Bravo 2009), go into the pairs: what a uniform expansion v_r = (v_r/r)_i r and a uniform
/// pressure p_i give there. A sum and its hoop part, both of which grow as 1/r, then cancel pair by pair,
/// near the axis too, where kernel sums of r and 1/r differ by tens of percent. With A the area
/// of a ring in the plane:
///
///     continuity   rho_i sum_j A_j [v_ij + (v_r/r)_i r_ij e_r] . gradW_ij
///     pressure     along x - sum_j m_j [P_i/r_i + P_j/r_j] dW/dx/(2 pi), P = p/rho^2: equal and opposite;
///                  along r - sum_j m_j/(2 pi r_j) [P_i + P_j] dW/dr, which is the same less p_i r_ij
///     viscosity    Morris's sum by w_ij/r_i, of v_ij - (v_r/r)_i r_ij e_r; from eta grad v^T its hoop part
///                  - 2 eta_i (v_r/r)_i goes off likewise
///     diffusion    psi_ij of density_diffusion.hpp by w_ij/r_i
///
/// w_ij = min((r_i + r_j)/2, 3 r_i, 3 r_j) is symmetric, so that momentum along the axis and mass are kept,
/// exact for linear fields, and bounded for a ring that comes near the axis.
///
/// Beyond the axis stand images of the particles (axis_images.hpp); r is |y| of them.
#pragma once

#include <cmath>
#include <numbers>

#include "fluid_solver/terms/continuity.hpp"
#include "fluid_solver/terms/density_diffusion.hpp"
#include "fluid_solver/terms/laminar_viscosity.hpp"
#include "fluid_solver/terms/pressure.hpp"
#include "fluid_solver/terms/variable_viscosity.hpp"

namespace toryu::fluid {

/// Of the area in the plane at a distance `y` from the axis, or as far beyond it: the volume of its ring over
/// it [m].
inline double circumference(double y) {
  return 2 * std::numbers::pi * std::abs(y);
}
TORYU_INLINE Lanes circumference(const Lanes& y) {
  return (2 * std::numbers::pi) * max(y, -y);
}

/// Areas of the rings [m2] of open faces (Faces) of cells at `x`: those that look towards the axis or away
/// from it lie half their length from the middle of the cell.
template <class Vector>
Vector ring_areas(const Vector& lower, const Vector& upper, const Vector& x) {
  return {(lower[0] + upper[0]) * circumference(x[1]),
          lower[1] * circumference(x[1] - 0.5 * lower[1]) + upper[1] * circumference(x[1] + 0.5 * upper[1])};
}

/// (v_r/r)_i [1/s].
TORYU_INLINE Lanes hoop_rate(const Targets& i) {
  return i.v[1] * inverse(i.x[1]);
}

/// w_ij/r_i.
TORYU_INLINE Lanes ring_weight(const Targets& i, const Sources& source, std::size_t j) {
  const Lanes r_j_over_r_i = std::abs(source.x[1][j]) * inverse(max(i.x[1], -i.x[1]));
  return min(0.5 * (1.0 + r_j_over_r_i), 3.0 * min(1.0, r_j_over_r_i));
}

struct RingContinuity {
  TORYU_INLINE void density(const Targets& i, const Sources&, std::size_t, const Pair& pair,
                            Rates& rates) const {
    const Lanes r_ij = pair.x_ij[1];
    rates.compression += pair.V_G * (dot(pair.v_ij, pair.x_ij) + hoop_rate(i) * r_ij * r_ij);
  }
  TORYU_INLINE void density_at_wall(const Targets& i, const Sources& wall, std::size_t w, const Pair& pair,
                                    Rates& rates) const {
    density(i, wall, w, pair, rates);
  }
};

struct RingPressure {
  TORYU_INLINE void momentum(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                             Rates& rates) const {
    const Lanes length_i = inverse(circumference(i.x[1]));
    const double length_j = 1 / circumference(source.x[1][j]);
    rates.push += i.p_rho2 * length_i + source.p_rho2[j] * length_j;
    rates.a[1] += (source.m[j] * pair.G * pair.x_ij[1]) * (i.p_rho2 * (length_i - length_j));
  }
  TORYU_INLINE void at_wall(const Targets& i, const Sources& wall, std::size_t w, const Pair& pair,
                            Rates& rates) const {
    momentum(i, wall, w, pair, rates);
  }
};

template <class Term>
struct RingViscosity {
  Term term;

  TORYU_INLINE void viscous(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    const Lanes hoop = hoop_rate(i);
    Pair ring = pair;
    ring.V_G = ring_weight(i, source, j) * pair.V_G;
    ring.v_viscous_ij[1] -= hoop * pair.x_ij[1];
    term.viscous(i, source, j, ring, rates);
    if constexpr (std::is_same_v<Term, VariableViscosityTerm>)
      rates.a[1] -= (2.0 * i.eta * hoop * inverse(i.rho)) * ring.V_G * pair.x_ij[1];
  }
};

template <class Term>
struct RingDiffusion {
  Term term;

  TORYU_INLINE void diffusion(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                              Rates& rates) const {
    Pair ring = pair;
    ring.V_G = ring_weight(i, source, j) * pair.V_G;
    term.diffusion(i, source, j, ring, rates);
  }
};

/// A term as it is about an axis.
template <class Term>
auto in_rings(const Term& term) {
  if constexpr (std::is_same_v<Term, LaminarViscosityTerm> || std::is_same_v<Term, VariableViscosityTerm>)
    return RingViscosity<Term>{term};
  else if constexpr (std::is_same_v<Term, DensityDiffusionTerm<false>> ||
                     std::is_same_v<Term, DensityDiffusionTerm<true>>)
    return RingDiffusion<Term>{term};
  else
    return term;
}

}  // namespace toryu::fluid
