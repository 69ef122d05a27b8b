#include "coupler/acceleration.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace toryu::coupling {

namespace {

/// A column of which less than this share is new beside the newer ones is left out.
constexpr double least_new_share = 0.01;

}  // namespace

Values AitkenRelaxation::next(const Values& x, const Values& r) {
  if (past_) {
    const Values change = r - past_->r;
    const double square = change.squaredNorm();
    if (square > 0) omega_ = -(x - past_->x).dot(change) / square;
  }
  past_ = Iterate{r, x};
  return x + omega_ * r;
}

void QuasiNewton::begin_window() {
  past_.reset();
  if (windows_.empty() || !windows_.front().empty()) windows_.emplace_front();
  while (windows_.size() > static_cast<std::size_t>(remembered_) + 1) windows_.pop_back();
}

Values QuasiNewton::next(const Values& x, const Values& r) {
  if (past_) windows_.front().push_front(Iterate{r - past_->r, x - past_->x});
  past_ = Iterate{r, x};

  // Each column is scaled to length 1: the differences shrink from one iteration to the next, but what they
  // say about the Jacobian does not.
  std::vector<Values> basis;
  Eigen::MatrixXd R(r.size(), 0), X(r.size(), 0);
  double omega = omega_;
  for (const auto& window : windows_)
    for (const auto& difference : window) {
      const double length = difference.r.norm();
      if (!(length > 0) || R.cols() == r.size()) continue;
      Values fresh = difference.r / length;
      for (int pass = 0; pass < 2; ++pass)  // the second one takes out what rounding left
        for (const Values& q : basis) fresh -= q.dot(fresh) * q;
      if (fresh.norm() < least_new_share) continue;
      basis.push_back(fresh.normalized());
      const Eigen::Index column = R.cols();
      R.conservativeResize(Eigen::NoChange, column + 1);
      X.conservativeResize(Eigen::NoChange, column + 1);
      R.col(column) = difference.r / length;
      X.col(column) = difference.x / length;
      const double of_column = -R.col(column).dot(X.col(column));
      if (of_column > 0) omega = std::min(omega, of_column);
    }
  rank_ = R.cols();
  if (rank_ == 0) return x + omega * r;
  const Values c = R.householderQr().solve(-r);
  return x + omega * r + (X + omega * R) * c;
}

}  // namespace toryu::coupling
