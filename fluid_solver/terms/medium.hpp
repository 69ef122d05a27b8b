/// What a term may know of the medium and its discretisation, for its constants and for what it says of
/// itself.
#pragma once

#include "common/run/solver.hpp"
#include "common/sph/kernel.hpp"

namespace toryu::fluid {

struct Medium {
  double rho_0, c_0;  ///< [kg/m3], [m/s]
  double d_0;         ///< [m]
  Kernel kernel;
  double h() const { return kernel.h(); }
};

}  // namespace toryu::fluid
