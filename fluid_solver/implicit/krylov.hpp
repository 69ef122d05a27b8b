/// Solves A x = b where only products A x are known: BiCGSTAB (van der Vorst 1992) of Eigen, for A is not
/// symmetric where walls extrapolate, with the diagonal blocks of A as preconditioner. Its sums have one
/// order whatever the number of threads.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

namespace toryu::fluid {

/// A x.
using Product = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct KrylovResult {
  Eigen::VectorXd x;
  long iterations = 0;
  double residual = 0;  ///< |b - A x|/|b| by recurrence
  bool converged = false;
};

/// Blocks of the components of one particle, component after component in x.
using DiagonalBlocks = std::vector<Eigen::Matrix2d>;

/// From x = 0 until |b - A x| < tolerance |b|, in at most `largest_iterations`.
KrylovResult solve_by_bicgstab(const Product& product, const DiagonalBlocks& blocks, const Eigen::VectorXd& b,
                               double tolerance, long largest_iterations);

}  // namespace toryu::fluid
