#include "fluid_solver/implicit/krylov.hpp"

#include <algorithm>
#include <cmath>

namespace toryu::fluid {

namespace {

/// Directions between restarts.
constexpr long most_directions = 60;

/// An orthonormal basis Q of the Krylov space, and the least squares problem |b - A M^-1 Q y| in it, H made
/// upper triangular by rotations (Saad & Schultz 1986).
class Directions {
 public:
  Directions(const Eigen::VectorXd& r, long most)
      : Q_(r.size(), most + 1),
        H_(Eigen::MatrixXd::Zero(most + 1, most)),
        g_(Eigen::VectorXd::Zero(most + 1)) {
    g_[0] = r.norm();
    Q_.col(0) = r / g_[0];
  }
  long count() const { return static_cast<long>(turns_.size()); }
  Eigen::VectorXd newest() const { return Q_.col(count()); }
  double residual() const { return std::abs(g_[count()]); }

  /// Takes in w, A M^-1 of the newest.
  void add(Eigen::VectorXd w) {
    const long k = count();
    for (long i = 0; i <= k; ++i) {
      H_(i, k) = Q_.col(i).dot(w);
      w -= H_(i, k) * Q_.col(i);
    }
    H_(k + 1, k) = w.norm();
    if (H_(k + 1, k) > 0) Q_.col(k + 1) = w / H_(k + 1, k);
    auto column = H_.col(k);
    for (long i = 0; i < k; ++i)
      column.applyOnTheLeft(i, i + 1, turns_[static_cast<std::size_t>(i)].adjoint());
    turns_.emplace_back().makeGivens(column[k], column[k + 1]);
    column.applyOnTheLeft(k, k + 1, turns_.back().adjoint());
    g_.applyOnTheLeft(k, k + 1, turns_.back().adjoint());
  }

  /// Q y that leaves the least.
  Eigen::VectorXd best() const {
    const long k = count();
    return Q_.leftCols(k) * H_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g_.head(k));
  }

 private:
  Eigen::MatrixXd Q_, H_;
  Eigen::VectorXd g_;
  std::vector<Eigen::JacobiRotation<double>> turns_;
};

}  // namespace

BlockJacobi::BlockJacobi(const DiagonalBlocks& blocks) {
  for (const auto& block : blocks) inverse_.push_back(block.inverse());
}

Eigen::VectorXd BlockJacobi::operator()(const Eigen::VectorXd& b) const {
  const auto n = static_cast<Eigen::Index>(inverse_.size());
  Eigen::VectorXd x = b;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d of_i = inverse_[static_cast<std::size_t>(i)] * Eigen::Vector2d(b[i], b[n + i]);
    x[i] = of_i[0];
    x[n + i] = of_i[1];
  }
  return x;
}

KrylovResult solve_by_gmres(const Product& product, const Product& preconditioner, const Eigen::VectorXd& b,
                            double tolerance, long largest_iterations) {
  const double wanted = tolerance * b.norm();
  KrylovResult result{.x = Eigen::VectorXd::Zero(b.size())};
  for (Eigen::VectorXd r = b; r.norm() > wanted && result.iterations < largest_iterations;) {
    const long most = std::min(most_directions, largest_iterations - result.iterations);
    Directions directions(r, most);
    while (directions.count() < most && directions.residual() > wanted)
      directions.add(product(preconditioner(directions.newest())));
    result.iterations += directions.count();
    result.x += preconditioner(directions.best());
    if (directions.residual() <= wanted) break;
    r = b - product(result.x);
  }
  return result;
}

}  // namespace toryu::fluid
