/// Developed flow of a generalised Newtonian medium in a tube at rest, by numerical integration: the shear
/// stress tau = tau_w r/R grows as a straight line whatever the rheology, eta(gdot) gdot = tau gives the
/// shear rate, and its integral the velocity (Bird, Armstrong & Hassager 1987, section 4.2).
#pragma once

#include <cmath>
#include <functional>
#include <vector>

namespace toryu::fluid {

class TubeSolution {
 public:
  /// `eta` [Pa s] of the shear rate [1/s]; `diameter` [m]; `mean` velocity [m/s].
  TubeSolution(std::function<double(double)> eta, double diameter, double mean)
      : eta_(std::move(eta)), radius_(0.5 * diameter) {
    double low = 1e-9, high = 1e9;  // of the stress at the wall [Pa]
    while (high / low > 1 + 1e-12) {
      tau_w_ = std::sqrt(low * high);
      integrate();
      (mean_ < mean ? low : high) = tau_w_;
    }
  }

  double pressure_gradient() const { return -2 * tau_w_ / radius_; }  ///< dp/dx [Pa/m]
  double largest_velocity() const { return velocity_.front(); }       ///< on the axis [m/s]
  double velocity(double r) const {
    const double place = std::min(r / radius_, 1.0) * intervals;
    const auto k = std::min(static_cast<std::size_t>(place), velocity_.size() - 2);
    return velocity_[k] + (place - static_cast<double>(k)) * (velocity_[k + 1] - velocity_[k]);
  }

 private:
  static constexpr int intervals = 2000;

  double shear_rate(double tau) const {
    double low = 1e-15, high = 1e15;
    while (high / low > 1 + 1e-13) {
      const double gdot = std::sqrt(low * high);
      (eta_(gdot) * gdot < tau ? low : high) = gdot;
    }
    return low;
  }
  /// From the wall to the axis, by the midpoint rule.
  void integrate() {
    const double step = radius_ / intervals;
    velocity_.assign(intervals + 1, 0.0);
    mean_ = 0;
    for (int k = intervals; k-- > 0;) {
      const auto inner = static_cast<std::size_t>(k);
      const double share = (k + 0.5) / intervals;  // r/R
      velocity_[inner] = velocity_[inner + 1] + step * shear_rate(tau_w_ * share);
      mean_ += (velocity_[inner] + velocity_[inner + 1]) * share / intervals;
    }
  }

  std::function<double(double)> eta_;
  double radius_, tau_w_ = 0, mean_ = 0;
  std::vector<double> velocity_;  ///< from the axis to the wall
};

}  // namespace toryu::fluid
