/// Developed flow of a generalised Newtonian medium between two plates at rest, or in a tube, by numerical
/// integration: the shear stress falls from the wall to the middle as a straight line whatever the rheology,
/// eta(gdot) gdot = tau gives the shear rate, and its integral, from the slip at the wall on, the velocity
/// (Bird, Armstrong & Hassager 1987, section 4.2).
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu::fluid {

class DevelopedFlow {
 public:
  /// `eta` [Pa s] of the shear rate [1/s]; plates at y = 0 and `width` [m], or a tube of that diameter about
  /// y = 0; `mean` velocity [m/s]; `slip` [m/s] at a wall of the shear stress [Pa].
  DevelopedFlow(
      std::function<double(double)> eta, double width, double mean, Geometry geometry = Geometry::plane,
      std::function<double(double)> slip = [](double) { return 0.0; })
      : eta_(std::move(eta)), slip_(std::move(slip)), half_(0.5 * width), geometry_(geometry) {
    double low = 1e-9, high = 1e9;  // of the stress at the wall [Pa]
    while (high / low > 1 + 1e-12) {
      tau_w_ = std::sqrt(low * high);
      integrate();
      (mean_ < mean ? low : high) = tau_w_;
    }
  }

  double wall_stress() const { return tau_w_; }           ///< [Pa]
  double slip_speed() const { return velocity_.back(); }  ///< [m/s]
  double pressure_gradient() const {                      ///< dp/dx [Pa/m]
    return -(geometry_ == Geometry::plane ? 1 : 2) * tau_w_ / half_;
  }
  double largest_velocity() const { return velocity_.front(); }  ///< in the middle [m/s]
  double velocity(double y) const {
    const double off = geometry_ == Geometry::plane ? std::abs(y - half_) : y;  // the middle
    const double place = std::min(off / half_, 1.0) * intervals;
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
  /// From the wall to the middle, by the midpoint rule.
  void integrate() {
    const double step = half_ / intervals;
    velocity_.assign(intervals + 1, slip_(tau_w_));
    mean_ = 0;
    for (int k = intervals; k-- > 0;) {
      const auto inner = static_cast<std::size_t>(k);
      const double share = (k + 0.5) / intervals;  // of the way to the wall
      velocity_[inner] = velocity_[inner + 1] + step * shear_rate(tau_w_ * share);
      const double ring = geometry_ == Geometry::plane ? 1 : 2 * share;
      mean_ += 0.5 * (velocity_[inner] + velocity_[inner + 1]) * ring / intervals;
    }
  }

  std::function<double(double)> eta_, slip_;
  double half_, tau_w_ = 0, mean_ = 0;
  Geometry geometry_;
  std::vector<double> velocity_;  ///< from the middle to the wall
};

}  // namespace toryu::fluid
