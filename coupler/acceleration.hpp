/// How an implicit scheme gets from one guess of the interface's motion to the next. With x_k the k-th guess
/// of a window and x~_k the solid's answer to the load that it led to, the residual is r_k = x~_k - x_k:
///
///     fixed         x_k+1 = x_k + omega r_k
///     Aitken        omega_k = -(x_k - x_k-1) . (r_k - r_k-1)/|r_k - r_k-1|^2         Kuettler & Wall 2008
///     quasi-Newton  x_k+1 = x_k + omega r_k + (X + omega R) c, c the least-squares solution of R c = -r_k
///
/// The columns of R and X are differences of r and x between iterations (interface quasi-Newton with least
/// squares, Degroote et al. 2009). What no column has shown yet goes by omega, as in Anderson's (1965)
/// mixing: 1, as usual, lets every mode grow that is not among the columns, and where the fluid is
/// compressible all modes of the interface feel nearly the same added mass. Aitken's omega fits all of them.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <iosfwd>
#include <memory>
#include <optional>

namespace toryu::coupling {

/// Positions of all interface particles [m].
using Values = Eigen::VectorXd;

/// A residual and the guess that it belongs to, or the differences of both.
struct Iterate {
  Values r, x;
};

template <class Archive>
void serialize(Archive& archive, Iterate& iterate) {
  auto& [r, x] = iterate;
  archive(r, x);
}

class Acceleration {
 public:
  virtual ~Acceleration() = default;
  virtual void begin_window() {}
  /// The guess after `x`, whose residual is `r`.
  virtual Values next(const Values& x, const Values& r) = 0;
  /// What it has learned, to a checkpoint and back.
  virtual void write_state(std::ostream& /*stream*/) const {}
  virtual void read_state(std::istream& /*stream*/) {}
};

class FixedRelaxation final : public Acceleration {
 public:
  explicit FixedRelaxation(double factor) : omega_(factor) {}
  Values next(const Values& x, const Values& r) override { return x + omega_ * r; }

 private:
  double omega_;
};

/// A window starts with the last omega of the one before, the first with `factor`.
class AitkenRelaxation final : public Acceleration {
 public:
  explicit AitkenRelaxation(double factor) : state_{.omega = factor} {}
  void begin_window() override { state_.past.reset(); }
  Values next(const Values& x, const Values& r) override;
  double factor() const { return state_.omega; }

  struct State {
    double omega = 0;
    std::optional<Iterate> past = {};  ///< the iteration before
  };
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;

 private:
  State state_;
};

template <class Archive>
void serialize(Archive& archive, AitkenRelaxation::State& state) {
  auto& [omega, past] = state;
  archive(omega, past);
}

/// Columns that are nearly a combination of newer ones are filtered out, newest first: an older one that says
/// nearly the same in another way would spoil what the newer ones have learned.
class QuasiNewton final : public Acceleration {
 public:
  /// `remembered_windows`: how many earlier windows' differences are used too.
  QuasiNewton(double factor, int remembered_windows) : omega_(factor), remembered_(remembered_windows) {}
  void begin_window() override;
  Values next(const Values& x, const Values& r) override;
  /// Columns that the last step used.
  Eigen::Index rank() const { return rank_; }

  struct State {
    /// Differences, the newest window first, in each the newest first.
    std::deque<std::deque<Iterate>> windows;
    std::optional<Iterate> past;  ///< the iteration before
  };
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;

 private:
  double omega_;
  int remembered_;
  State state_;
  Eigen::Index rank_ = 0;
};

template <class Archive>
void serialize(Archive& archive, QuasiNewton::State& state) {
  auto& [windows, past] = state;
  archive(windows, past);
}

}  // namespace toryu::coupling
