/// Solves A x = b where only products A x are known: GMRES (Saad & Schultz 1986), for A is not symmetric
/// where walls extrapolate, with a preconditioner from the right, so that the residual is that of b - A x. A
/// product costs far more than its sums, and BiCGSTAB, which needs two an iteration, takes a quarter more of
/// them (cases/abrasive_throat). The sums have one order whatever the number of threads.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

namespace toryu::fluid {

/// A x.
using Product = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct KrylovResult {
  Eigen::VectorXd x;
  long iterations = 0;  ///< products, apart from those of restarts
};

/// Blocks of the components of one particle, component after component in x.
using DiagonalBlocks = std::vector<Eigen::Matrix2d>;

/// Divides by the diagonal blocks; what has none, behind, stays.
class BlockJacobi {
 public:
  explicit BlockJacobi(const DiagonalBlocks& blocks);
  Eigen::VectorXd operator()(const Eigen::VectorXd& b) const;

 private:
  DiagonalBlocks inverse_;
};

/// From x = 0 until |b - A x| < tolerance |b|, in at most `largest_iterations`.
KrylovResult solve_by_gmres(const Product& product, const Product& preconditioner, const Eigen::VectorXd& b,
                            double tolerance, long largest_iterations);

}  // namespace toryu::fluid
