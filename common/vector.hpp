/// The dimension of space, and the small vectors and matrices that follow from it. Everything else is written
/// for `dim`, so that going to three dimensions changes this line and the shapes of a scene.
#pragma once

#include <Eigen/Core>

namespace toryu {

inline constexpr int dim = 2;

using Vec = Eigen::Matrix<double, dim, 1>;
using Mat = Eigen::Matrix<double, dim, dim>;

}  // namespace toryu
