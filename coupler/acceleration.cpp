#include "coupler/acceleration.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "common/state/serialize.hpp"

namespace toryu::coupling {

namespace {

/// A column of which less than this share is new beside the newer ones is left out.
constexpr double least_new_share = 0.01;

}  // namespace

Values AitkenRelaxation::next(const Values& x, const Values& r) {
  auto& [omega, past] = state_;
  if (past) {
    const Values change = r - past->r;
    const double square = change.squaredNorm();
    if (square > 0) omega = -(x - past->x).dot(change) / square;
  }
  past = Iterate{r, x};
  return x + omega * r;
}

void AitkenRelaxation::write_state(std::ostream& stream) const {
  write_states(stream, state_);
}
void AitkenRelaxation::read_state(std::istream& stream) {
  read_states(stream, state_);
}

void QuasiNewton::begin_window() {
  auto& [windows, past] = state_;
  past.reset();
  if (windows.empty() || !windows.front().empty()) windows.emplace_front();
  while (windows.size() > static_cast<std::size_t>(remembered_) + 1) windows.pop_back();
}

Values QuasiNewton::next(const Values& x, const Values& r) {
  auto& [windows, past] = state_;
  if (past) windows.front().push_front(Iterate{r - past->r, x - past->x});
  past = Iterate{r, x};

  // Each column is scaled to length 1: the differences shrink from one iteration to the next, but what they
  // say about the Jacobian does not.
  std::vector<Values> basis;
  Eigen::MatrixXd R(r.size(), 0), X(r.size(), 0);
  double omega = omega_;
  for (const auto& window : windows)
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

void QuasiNewton::write_state(std::ostream& stream) const {
  write_states(stream, state_);
}
void QuasiNewton::read_state(std::istream& stream) {
  read_states(stream, state_);
}

}  // namespace toryu::coupling
