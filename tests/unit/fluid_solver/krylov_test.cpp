// Linear systems of which only products are known.
#include "fluid_solver/implicit/krylov.hpp"

#include <gtest/gtest.h>

namespace toryu::fluid {
namespace {

/// Of 1, 2, ... on the diagonal and ones above it.
struct Solved {
  long iterations;
  double residual;  ///< |b - A x|/|b|
};
Solved solved(long size, double tolerance, long most) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(size, size);
  for (long i = 0; i < size; ++i) A(i, i) = static_cast<double>(i + 1), A(i, (i + 1) % size) += 1;
  const BlockJacobi ones(DiagonalBlocks(static_cast<std::size_t>(size / 2), Eigen::Matrix2d::Identity()));
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(size);
  const KrylovResult found = solve_by_gmres(
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return A * x; }, ones, b, tolerance, most);
  return {found.iterations, (b - A * found.x).norm() / b.norm()};
}

TEST(Gmres, SolvesInAsManyIterationsAsThereAreUnknowns) {
  const Solved exact = solved(20, 1e-12, 100);
  EXPECT_LT(exact.residual, 1e-12);
  EXPECT_LE(exact.iterations, 20);
  const Solved rough = solved(20, 0.1, 100);
  EXPECT_LT(rough.residual, 0.1 * (1 + 1e-9));
  EXPECT_LT(rough.iterations, exact.iterations);
  EXPECT_EQ(solved(20, 1e-12, 3).iterations, 3);
}

TEST(Gmres, GoesOnFromWhatItHasAfterSixtyDirections) {
  const Solved restarted = solved(400, 1e-8, 2000);
  EXPECT_GT(restarted.iterations, 60);
  EXPECT_LT(restarted.residual, 1e-8 * (1 + 1e-6));
}

}  // namespace
}  // namespace toryu::fluid
