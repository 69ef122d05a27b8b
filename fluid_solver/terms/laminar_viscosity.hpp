/// Laminar viscosity (Morris, Fox & Zhu 1997): sum_j m_j 2 mu/(rho_i rho_j) x_ij . gradW_ij/r_ij^2 v_ij.
///
/// The 0.01 h^2 that is usual beside r_ij^2 is left out: x_ij . gradW_ij/r_ij^2 is finite without it, and
/// with it the viscosity comes out 1.1 % too small at any resolution.
///
/// This stands for the divergence of the viscous stress in (4), mu (grad v + grad v^T - 2/3 div v I), which
/// is mu (laplacian v + 1/3 grad div v): the second part vanishes with the compressibility, of the order of
/// the squared Mach number. The stress itself would have to be formed from a velocity gradient and
/// differentiated again: a sum over pairs more, blind to a velocity that alternates from particle to
/// particle, and one-sided at walls, where this form sees v_w-f (28). It is equal and opposite pair by pair,
/// so momentum is kept; angular momentum only as far as it converges. tests/validation/couette_test.cpp finds
/// the nominal viscosity within 2 % at 20 particles across. At a free surface it damps half as much as a
/// Newtonian liquid (cases/standing_wave).
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct LaminarViscosity {
  static constexpr const char* section = "laminar_viscosity";
  static constexpr const char* help = "viscosity of a Newtonian medium";
  double dynamic_viscosity = 1e-3;  ///< [Pa s]
};
inline void describe(ParameterTable& table, LaminarViscosity& viscosity) {
  table.number("dynamic_viscosity", viscosity.dynamic_viscosity,
               {.unit = "Pa.s", .minimum = 0, .required = true, .help = "mu (Morris, Fox & Zhu 1997)"});
}

struct LaminarViscosityTerm {
  double mu;

  TORYU_INLINE void viscous(const Targets& i, const Sources&, std::size_t, const Pair& pair,
                            Rates& rates) const {
    const Lanes factor = (2.0 * mu * inverse(i.rho)) * pair.V_G;  // V_j = m_j/rho_j
    for (int a = 0; a < dim; ++a) rates.a[a] += factor * pair.v_viscous_ij[a];
  }
};

inline ActiveTerm text(const LaminarViscosity& viscosity, const Medium&) {
  return {"laminar viscosity", "sum_j m_j 2 mu/(rho_i rho_j) x_ij . gradW_ij/r^2 v_ij",
          "Morris, Fox & Zhu 1997", fmt::format("mu {} Pa s", viscosity.dynamic_viscosity)};
}

}  // namespace toryu::fluid
