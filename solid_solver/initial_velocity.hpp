/// How a solid moves at the start.
#pragma once

#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/vector.hpp"

namespace toryu::solid {

enum class VelocityProfile { uniform, cantilever_mode_1, linear, bar_mode_1, alternating };

/// `uniform`: all particles move with `velocity`. `linear`: v(x) = velocity + gradient (x - origin), a
/// stretch, a shear or a turn. `cantilever_mode_1`: the first bending mode of a beam that is held at `origin`
/// and reaches `length` along x (Landau & Lifshitz 1970, as used by Gray et al. 2001),
///
///     v(x) = velocity F(x)/F(length),   k length = 1.8751041
///     F(x) = (cos kL + cosh kL)(cosh kx - cos kx) + (sin kL - sinh kL)(sinh kx - sin kx)
///
/// with x from `origin`, and zero behind it. `bar_mode_1`: the first longitudinal mode of a bar that is held
/// there, v(x) = velocity sin(pi x/(2 length)). `alternating`: plus and minus `velocity` on a chessboard with
/// squares of side `length` and a corner at `origin`: with squares of a spacing, what gradients do not see.
struct InitialVelocity {
  VelocityProfile profile = VelocityProfile::uniform;
  Vec velocity = Vec::Zero();                      ///< of all particles, or of the tip [m/s]
  Vec origin = Vec::Zero();                        ///< [m]
  double length = 1.0;                             ///< [m]
  std::vector<std::vector<double>> gradient = {};  ///< dv_x/dx, dv_x/dy and dv_y/dx, dv_y/dy [1/s]

  Vec at(const Vec& X) const;
  bool is_rigid() const;  ///< whether no distance changes by it
};
void describe(ParameterTable& table, InitialVelocity& v);

}  // namespace toryu::solid
