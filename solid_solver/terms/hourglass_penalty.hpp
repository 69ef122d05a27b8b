/// Hourglass control of the total Lagrangian form: a pair penalty on the part of the motion that the mean
/// deformation gradient of a particle does not see,
///
///     U = sum_i sum_j (k/4) V_i V_j w_ij |x_ij - F_i X_ij|^2,   w_ij = -W'(R_ij)/R_ij
///     f_i = -(k/2) V_i sum_j V_j w_ij (2 x_ij - (F_i + F_j) X_ij)
///
/// (Ganzenmueller 2015, eq. 17-20, who takes w_ij = W/R_ij^2, k in proportion to E, and the part along x_ij.)
/// With this w_ij, F_i is the least-squares fit to the same differences, so dU/dF_i = 0 and the force is the
/// exact gradient of U: energy, momentum and angular momentum are kept, and no square root is needed.
///
/// **How stiff.** In bending (u_x = -kappa x y, u_y = kappa/2 (x^2 + n y^2), n = nu/(1 - nu)) sums over
/// particles lack a share of the energy E/(1 - nu^2) kappa^2 that falls with the square of the rows: rows do
/// not see the strain's slope across them, and outer rows fit it from one side. The penalty holds the energy
/// k kappa^2 (7 + 2 n + 3 n^2)/4 times the same square. So one number alpha makes up for the lack,
///
///     k = alpha E 7/((1 - nu^2) (7 + 2 n + 3 n^2)),   that is alpha E for nu = 0
///
/// Both energies of a strip at nu = 0, summed over its lattice at h = 1.3 d0: the lack is 6.6/N^2 for N = 5
/// rows and 7.9/N^2 for 10, the penalty's energy for alpha = 1 is 4.5/N^2 and 5.1/N^2, so alpha is 1.46
/// and 1.54. A free plate in its first bending mode (eigenvalues of the linearised equations) wants 1.44
/// and 1.52, within 6 % the same for nu from 0 to 0.49 and h/d0 from 1.1 to 2.
#pragma once

#include "common/case/parameter_table.hpp"
#include "solid_solver/material.hpp"

namespace toryu::solid {

struct HourglassPenalty {
  double coefficient = 1.51;  ///< alpha

  double stiffness(const ElasticMaterial& material) const {  ///< k [Pa]
    const double nu = material.poissons_ratio, n = nu / (1.0 - nu);
    return coefficient * material.youngs_modulus * 7.0 / ((1.0 - nu * nu) * (7.0 + n * (2.0 + 3.0 * n)));
  }
};
inline void describe(ParameterTable& table, HourglassPenalty& p) {
  table.number("coefficient", p.coefficient,
               {.minimum = 0,
                .maximum = 10,
                .help = "alpha; 1.51 makes plates of 4 rows and more as stiff as they are"});
}

}  // namespace toryu::solid
