#include "coupler/relaxation.hpp"

#include <Eigen/QR>

namespace toryu {

namespace {

/// A column of which less than this share is new counts as a combination of the others.
constexpr double least_new_share = 1e-6;

}  // namespace

Values AitkenRelaxation::next(const Values& x, const Values& r) {
  if (past_r_) {
    const Values change = r - *past_r_;
    const double square = change.squaredNorm();
    if (square > 0) omega_ *= -past_r_->dot(change) / square;
  }
  past_r_ = r;
  return x + omega_ * r;
}

void QuasiNewton::begin_window() {
  past_.reset();
  if (windows_.empty() || !windows_.front().empty()) windows_.emplace_front();
  while (windows_.size() > static_cast<std::size_t>(remembered_) + 1) windows_.pop_back();
}

Values QuasiNewton::next(const Values& x, const Values& r) {
  const Values answer = x + r;
  if (past_) windows_.front().push_front({r - past_->r, answer - past_->answer});
  past_ = Difference{r, answer};

  Eigen::Index count = 0;
  for (const auto& window : windows_) count += static_cast<Eigen::Index>(window.size());
  count = std::min(count, r.size());
  rank_ = 0;
  if (count == 0) return x + omega_ * r;
  // Each column is scaled to length 1: the differences shrink from one iteration to the next, but what they
  // say about the Jacobian does not.
  Eigen::MatrixXd V(r.size(), count), W(r.size(), count);
  Eigen::Index column = 0;
  for (const auto& window : windows_)
    for (const auto& difference : window) {
      const double length = difference.r.norm();
      if (column == count || !(length > 0)) continue;
      V.col(column) = difference.r / length;
      W.col(column++) = difference.answer / length;
    }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(least_new_share);
  decomposition.compute(V.leftCols(column));
  rank_ = decomposition.rank();
  const Values c = decomposition.solve(-r);
  return answer + W.leftCols(column) * c;
}

}  // namespace toryu
