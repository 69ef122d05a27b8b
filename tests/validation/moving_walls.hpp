/// Walls that turn, against exact solutions: a rolling tank of water and a disc in a viscous fluid.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

inline constexpr double pi = std::numbers::pi;

/// Linear theory of a rectangular tank that rolls about the middle of its floor (Faltinsen & Timokha 2009):
/// of the surface's elevation in the tank sum b_n cos(k_n (x + L/2)), k_n = n pi/L, with theta the angle,
///
///     b_n'' + g k_n tanh(k_n H) b_n = -k_n tanh(k_n H) x_n (g theta + theta'' ((2/k_n) tanh(k_n H/2) - H))
///
/// x_n = -4 L/(n pi)^2, n odd: x by the same cosines. The surface is as high above the floor, which turns, as
/// H, so that its middle is shifted by -H theta.
class RollingTank {
 public:
  RollingTank(double length, double depth, const Turning& roll) : L_(length), H_(depth), roll_(roll) {}

  /// Integral of x over the water, in the tank [m3 per metre depth], after rows of `dt` [s].
  std::vector<double> moments(double dt, int rows) const {
    std::vector<double> sums(static_cast<std::size_t>(rows), 0.0);
    for (int n = 1; n < 10; n += 2) add_mode(n, dt, sums);
    return sums;
  }

 private:
  void add_mode(int n, double dt, std::vector<double>& sums) const {
    const double k = n * pi / L_, stiffness = k * std::tanh(k * H_), x_n = -4 * L_ / (n * n * pi * pi);
    const auto force = [&](double t) {
      const double angular = (roll_.rate_at(t + 1e-5) - roll_.rate_at(t - 1e-5)) / 2e-5;
      return -stiffness * x_n * (9.81 * roll_.angle_at(t) + angular * (2 / k * std::tanh(0.5 * k * H_) - H_));
    };
    double b = 0, rate = 0, t = 0;
    const double step = dt / 100;
    for (double& sum : sums) {
      for (int s = 0; s < 100; ++s, t += step) {  // leapfrog
        rate += 0.5 * step * (force(t) - 9.81 * stiffness * b);
        b += step * rate;
        rate += 0.5 * step * (force(t + step) - 9.81 * stiffness * b);
      }
      sum += b * x_n * L_ / 2;
    }
  }
  double L_, H_;
  Turning roll_;
};

/// Largest difference of the water's moment from theory over its largest.
inline double sloshing_error(double spacing) {
  const FluidCase the_case("sloshing_tank", {fmt::format("fluid.spacing={}", spacing)});
  const Motion& motion = the_case.scene.motions[0].motion;
  WeaklyCompressible solver = the_case.solver();
  const double dt = 0.05;
  const auto expected = RollingTank(1.0, 0.5, motion.rotation->turning).moments(dt, 80);
  double largest = 0, error = 0;
  for (std::size_t row = 0; row < expected.size(); ++row) {
    run_until(solver, dt * static_cast<double>(row + 1));
    const Pose pose = motion.pose_at(solver.time());
    const Particles& f = solver.particles();
    double moment = 0;
    for (std::size_t i = 0; i < f.count; ++i)
      moment += f.m[i] / 1000 * (pose.rotation.transpose() * (at(f.x, i) - pose.centre))[0];
    largest = std::max(largest, std::abs(expected[row]));
    error = std::max(error, std::abs(moment - expected[row]));
  }
  return error / largest;
}

/// Modified Bessel function of the second kind: integral of exp(-z cosh t) cosh(n t) from 0.
inline std::complex<double> bessel_k(int n, std::complex<double> z) {
  std::complex<double> sum = 0.5 * std::exp(-z);
  for (double t = 1e-3; t < 12; t += 1e-3) sum += std::exp(-z * std::cosh(t)) * std::cosh(n * t);
  return 1e-3 * sum;
}

/// Torque over the angular velocity's amplitude, of a disc of radius R that swings in a fluid without end
/// [N s per metre depth]: 2 pi mu R^2 (z K_0(z)/K_1(z) + 2), z = (1 + i) R/sqrt(2 nu/sigma).
inline std::complex<double> torque_of_disc(double R, double mu, double nu, double sigma) {
  const std::complex<double> z = std::complex<double>(1, 1) * R / std::sqrt(2 * nu / sigma);
  return 2 * pi * mu * R * R * (z * bessel_k(0, z) / bessel_k(1, z) + 2.0);
}

/// Torque on the fluid over the last period, over the amplitude of the angular velocity cos(sigma t).
inline std::complex<double> measured_torque(double spacing) {
  const FluidCase the_case("turning_disc", {fmt::format("fluid.spacing={}", spacing)});
  WeaklyCompressible solver = the_case.solver();
  const double sigma = 2 * pi * 2, omega = 0.5 * sigma;
  run_until(solver, 0.5);
  std::complex<double> sum = 0;
  double length = 0;
  while (solver.time() < 1 - 1e-12) {
    const double dt = std::min(solver.time_step_limit(), 1 - solver.time()), t = solver.time() + 0.5 * dt;
    solver.advance(dt);
    for (const auto& seen : solver.observe())
      if (seen.name == "moment_from_disc") sum += dt * seen.value * std::polar(1.0, -sigma * t);
    length += dt;
  }
  return 2.0 * sum / length / omega;
}

/// Of the complex torque, relative.
inline double torque_error(double spacing) {
  const auto exact = torque_of_disc(0.1, 15.7, 0.0157, 4 * pi);
  return std::abs(measured_torque(spacing) - exact) / std::abs(exact);
}

}  // namespace toryu::fluid
