/// Hourglass control of the total Lagrangian form: a pair penalty on the part of the motion that the mean
/// deformation gradient of a particle does not see,
///
///     U = sum_i sum_j (alpha E/4) V_i V_j k_ij |x_ij - F_i X_ij|^2,   k_ij = -W'(R_ij)/R_ij
///     f_i = -(alpha E/2) V_i sum_j V_j k_ij (2 x_ij - (F_i + F_j) X_ij)
///
/// (Ganzenmueller 2015, eq. 17-20, who takes k_ij = W/R_ij^2 and the part along x_ij.) With this k_ij, F_i is
/// the least-squares fit to the same differences, so dU/dF_i = 0 and the force is the exact gradient of U:
/// energy, momentum and angular momentum are kept, and no square root is needed.
///
/// alpha = 1.5 corresponds to Ganzenmueller's 12. The softness of a plate of few rows and this stiffness then
/// cancel to leading order: period of the oscillating plate -0.7, +0.1, +0.7, +0.7 % at 4, 5, 8, 10 rows
/// (without: +34, +22, -, +6 %), h = 1.3 d0. Range 0 to 2.
#pragma once

#include "common/case/parameter_table.hpp"

namespace toryu {

struct HourglassPenalty {
  double coefficient = 1.5;  ///< alpha
};
inline void describe(ParameterTable& table, HourglassPenalty& p) {
  table.number("coefficient", p.coefficient,
               {.minimum = 0,
                .maximum = 10,
                .help = "alpha; 1.5 makes plates of 4 rows and more as stiff as they are"});
}

}  // namespace toryu
