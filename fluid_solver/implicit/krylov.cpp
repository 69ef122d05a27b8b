#include "fluid_solver/implicit/krylov.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace toryu::fluid {
namespace {
class ProductMatrix;
}
}  // namespace toryu::fluid

namespace Eigen::internal {
template <>
struct traits<toryu::fluid::ProductMatrix> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace toryu::fluid {

namespace {

/// A matrix as Eigen's solvers want it: "matrix-free solvers" of Eigen's manual.
class ProductMatrix : public Eigen::EigenBase<ProductMatrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  ProductMatrix(const Product& product_of, const DiagonalBlocks& diagonal)
      : product(product_of), blocks(diagonal) {}
  Eigen::Index rows() const { return 2 * static_cast<Eigen::Index>(blocks.size()); }
  Eigen::Index cols() const { return rows(); }
  template <class Rhs>
  Eigen::Product<ProductMatrix, Rhs, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

  const Product& product;
  const DiagonalBlocks& blocks;
};

/// Divides by the diagonal blocks.
class BlockJacobi {
 public:
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

  BlockJacobi& analyzePattern(const ProductMatrix&) { return *this; }
  BlockJacobi& factorize(const ProductMatrix& A) {
    inverse_.clear();
    for (const auto& block : A.blocks) inverse_.push_back(block.inverse());
    return *this;
  }
  BlockJacobi& compute(const ProductMatrix& A) { return factorize(A); }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    const auto n = static_cast<Eigen::Index>(inverse_.size());
    Eigen::VectorXd x(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector2d of_i = inverse_[static_cast<std::size_t>(i)] * Eigen::Vector2d(b[i], b[n + i]);
      x[i] = of_i[0];
      x[n + i] = of_i[1];
    }
    return x;
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
  DiagonalBlocks inverse_;
};

}  // namespace

}  // namespace toryu::fluid

namespace Eigen::internal {

template <class Rhs>
struct generic_product_impl<toryu::fluid::ProductMatrix, Rhs, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<toryu::fluid::ProductMatrix, Rhs,
                                generic_product_impl<toryu::fluid::ProductMatrix, Rhs>> {
  template <class Dest>
  static void scaleAndAddTo(Dest& sum, const toryu::fluid::ProductMatrix& A, const Rhs& x,
                            const double& factor) {
    sum += factor * A.product(x);
  }
};

}  // namespace Eigen::internal

namespace toryu::fluid {

KrylovResult solve_by_bicgstab(const Product& product, const DiagonalBlocks& blocks, const Eigen::VectorXd& b,
                               double tolerance, long largest_iterations) {
  const ProductMatrix A(product, blocks);
  Eigen::BiCGSTAB<ProductMatrix, BlockJacobi> solver;
  solver.setTolerance(tolerance);
  solver.setMaxIterations(largest_iterations);
  solver.compute(A);
  KrylovResult result;
  result.x = solver.solve(b);
  result.iterations = solver.iterations();
  result.residual = solver.error();
  result.converged = solver.info() == Eigen::Success;
  return result;
}

}  // namespace toryu::fluid
