/// A cantilever shaken at its clamp: tip over clamp against thin beam theory.
#include <Eigen/QR>
#include <numbers>

#include "solid_case.hpp"

namespace toryu::solid {
namespace {

constexpr double length = 0.4, thickness = 0.02;

/// (beta L)^2 of unit length for an angular frequency, in plane strain [1].
double beta_squared(double omega) {
  const double E = 2e6 / (1 - 0.4 * 0.4), rho = 1000;
  return omega * std::sqrt(12 * rho / E) / thickness * length * length;
}

/// w(L)/w(0) of a beam without damping, clamp and tip in one phase where it is positive.
double transfer(double omega) {
  const double b = std::sqrt(beta_squared(omega));
  return (std::cosh(b) + std::cos(b)) / (1 + std::cosh(b) * std::cos(b));
}

/// Amplitude at `omega` of values over time, beside what swings at the first natural frequency.
double amplitude(const std::vector<double>& times, const std::vector<double>& values, double omega) {
  const double omega_1 = 1.87510407 * 1.87510407 / beta_squared(1.0);
  const auto rows = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixXd A(rows, 5);
  Eigen::VectorXd b(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double t = times[static_cast<std::size_t>(k)];
    A.row(k) << std::sin(omega * t), std::cos(omega * t), std::sin(omega_1 * t), std::cos(omega_1 * t), 1;
    b[k] = values[static_cast<std::size_t>(k)];
  }
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b);
  return std::hypot(x[0], x[1]);
}

/// The measured ratio, between the end of the ramp and that of the case.
double measured(double frequency, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all = overrides;
  all.push_back(fmt::format("motion.shaker.sine.0.frequency={}", frequency));
  const auto model = solid_case("shaken_beam", all);
  std::vector<double> times, values;
  double t = 0;
  for (int row = 1; row <= 800; ++row) {
    const double end = 0.005 * row;
    while (t < end - 1e-12) {
      const double dt = std::min(model->time_step_limit(), end - t);
      model->advance(dt);
      t += dt;
    }
    if (t > 1) times.push_back(t), values.push_back(observed(*model, "tip_displacement_y"));
  }
  return amplitude(times, values, 2 * std::numbers::pi * frequency) / 0.001;
}

TEST(ShakenBeam, AnswersAsABeamDoes) {
  const double found = measured(0.6), expected = std::abs(transfer(2 * std::numbers::pi * 0.6));
  RecordProperty("over_theory", fmt::format("{:.5f}", found / expected));
  EXPECT_NEAR(found / expected, 1, 0.01);
}

}  // namespace
}  // namespace toryu::solid
