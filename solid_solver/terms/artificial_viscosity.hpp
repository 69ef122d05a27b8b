/// Artificial viscosity between particles that approach each other (Monaghan 1992; thesis eq. 23-24):
///
///     Pi_ij = (-alpha c theta_ij + beta theta_ij^2)/rho_ij where v_ij.x_ij < 0, else 0
///     theta_ij = h v_ij.x_ij/(r_ij^2 + 0.01 h^2)
///
/// c is the bulk sound speed sqrt(K/rho0); between two materials c and rho_ij are the means. alpha = beta = 1
/// in the thesis and in Gray et al. (2001).
#pragma once

#include "common/case/parameter_table.hpp"
#include "common/sph/lanes.hpp"
#include "solid_solver/material.hpp"

namespace toryu::solid {

struct ArtificialViscosity {
  double alpha = 1.0;
  double beta = 1.0;
};
inline void describe(ParameterTable& table, ArtificialViscosity& p) {
  table.number("alpha", p.alpha,
               {.minimum = 0, .maximum = 10, .help = "linear coefficient A (Monaghan 1992)"});
  table.number("beta", p.beta,
               {.minimum = 0, .maximum = 10, .help = "quadratic coefficient B (Monaghan 1992)"});
}

/// The term as the pair loop needs it, of one material or, in lanes, with the means of two.
template <class Number = double>
struct PairViscosity {
  Number alpha_c;  ///< alpha times the sound speed [m/s]
  double beta;
  double h;            ///< [m]
  Number inverse_rho;  ///< of the unloaded solid [m3/kg]

  /// Pi_ij [m5/(kg s2)] from v_ij.x_ij [m2/s] and r_ij^2 [m2].
  Lanes operator()(const Lanes& v_dot_x, const Lanes& r_squared) const {
    const Lanes theta = h * negative_part(v_dot_x) * inverse(r_squared + 0.01 * h * h);
    return (beta * theta - alpha_c) * theta * inverse_rho;
  }
};

inline PairViscosity<> pair_viscosity(const ArtificialViscosity& term, const ElasticMaterial& material,
                                      double h) {
  return {term.alpha * material.bulk_sound_speed(), term.beta, h, 1.0 / material.density};
}

}  // namespace toryu::solid
