/// Artificial viscosity, (23)-(24) (Monaghan 1992): - sum_j m_j Pi_ij gradW_ij with
///
///     Pi_ij = (-A c_ij theta_ij + B theta_ij^2)/rho_ij where v_ij . x_ij < 0, else 0,
///     theta_ij = h v_ij . x_ij/(r_ij^2 + 0.01 h^2)
///
/// c_ij is c_0 and rho_ij the mean of the pair. Pi_ij >= 0: approaching particles repel, energy is taken out.
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

static_assert(dim == 2, "the effective viscosity is a sum over a lattice of the plane");

struct ArtificialViscosity {
  static constexpr const char* section = "artificial_viscosity";
  static constexpr const char* help = "between approaching pairs (Monaghan 1992)";
  double alpha = 0.02;
  double beta = 0.0;
};
inline void describe(ParameterTable& table, ArtificialViscosity& viscosity) {
  table.number("alpha", viscosity.alpha,
               {.minimum = 0,
                .maximum = 10,
                .help = "linear coefficient (Monaghan 1992); 0.02 in delta-SPH, 1 in Kato's thesis"});
  table.number("beta", viscosity.beta,
               {.minimum = 0, .maximum = 10, .help = "quadratic coefficient (Monaghan 1992)"});
}

struct ArtificialViscosityTerm {
  double alpha, beta, h, c_0;

  TORYU_INLINE void viscous(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    const Lanes v_x = dot(pair.v_viscous_ij, pair.x_ij);
    const Lanes rho_sum = i.rho + source.rho[j];
    const Lanes both = inverse(pair.soft_r2 * rho_sum);  // one division for theta and for 1/rho_ij
    const Lanes theta_h = negative_part(v_x) * (both * rho_sum);
    rates.push += (theta_h * ((2 * beta * h * h) * theta_h - 2 * alpha * c_0 * h)) * (both * pair.soft_r2);
  }
};

/// The kinematic viscosity [m2/s] that the linear coefficient acts like in sheared flow, from lattice sums at
/// h = 1.2 d_0, where only approaching pairs count. Disorder changes the second digit.
inline double effective_kinematic_viscosity(double alpha, double h, double c_0) {
  return 0.049 * alpha * h * c_0;
}

inline ActiveTerm text(const ArtificialViscosity& viscosity, const Medium& medium) {
  return {
      "artificial viscosity", "- sum_j m_j Pi_ij gradW_ij", "Monaghan 1992; thesis eq. 23-24",
      fmt::format("alpha {}, beta {}; acts like a kinematic viscosity of {:.3g} m2/s", viscosity.alpha,
                  viscosity.beta, effective_kinematic_viscosity(viscosity.alpha, medium.h(), medium.c_0))};
}

}  // namespace toryu::fluid
