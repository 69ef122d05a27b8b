/// The dimension of space, and the small vectors and matrices that follow from it. What is written for two
/// dimensions alone (kernel constants, strips, tensors of the plane, the terms that rest on them) says so by
/// a static_assert: with another `dim` it does not compile, rather than compute something else.
#pragma once

#include <Eigen/Core>

namespace toryu {

inline constexpr int dim = 2;

using Vec = Eigen::Matrix<double, dim, 1>;
using Mat = Eigen::Matrix<double, dim, dim>;

}  // namespace toryu
