/// The dimension of space, and the small vectors and matrices that follow from it. What is written for two
/// dimensions alone (kernel constants, strips, tensors of the plane, the terms that rest on them) says so by
/// a static_assert: with another `dim` it does not compile, rather than compute something else.
#pragma once

#include <Eigen/Core>

namespace toryu {

inline constexpr int dim = 2;

using Vec = Eigen::Matrix<double, dim, 1>;
using Mat = Eigen::Matrix<double, dim, dim>;

static_assert(dim == 2, "cross products of the plane");
/// The component across the plane: positive if b lies anticlockwise of a.
inline double cross(const Vec& a, const Vec& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace toryu
