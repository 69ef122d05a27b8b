/// A cantilever shaken at its clamp: tip over clamp against thin beam theory.
#include <Eigen/Cholesky>
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
  using Row = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();  // least squares
  Row b = Row::Zero();
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double t = times[k];
    Row row;
    row << std::sin(omega * t), std::cos(omega * t), std::sin(omega_1 * t), std::cos(omega_1 * t), 1;
    A += row * row.transpose();
    b += values[k] * row;
  }
  const Row x = A.ldlt().solve(b);
  return std::hypot(x[0], x[1]);
}

/// The measured ratio, between the end of the ramp and that of the case.
double measured(double frequency, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all = overrides;
  all.push_back(fmt::format("motion.shaker.sine.0.frequency={}", frequency));
  const auto model = solid_case("shaken_beam", all);
  std::vector<double> times, values;
  const double interval = 0.005;
  for (int row = 1; row <= 800; ++row) {
    const double steps = std::ceil(interval / model->time_step_limit());  // equal ones, as in a run
    for (int step = 0; step < steps; ++step) model->advance(interval / steps);
    if (row <= 200) continue;  // the ramp
    times.push_back(interval * row);
    values.push_back(observed(*model, "tip_displacement_y"));
  }
  return amplitude(times, values, 2 * std::numbers::pi * frequency) / 0.001;
}

TEST(ShakenBeam, AnswersAsABeamDoes) {
  for (const double frequency : {0.6, 1.6}) {  // below the first resonance and beyond it
    const double found = measured(frequency), expected = std::abs(transfer(2 * std::numbers::pi * frequency));
    RecordProperty(fmt::format("over_theory_{}", frequency), fmt::format("{:.5f}", found / expected));
    EXPECT_NEAR(found / expected, 1, 0.01) << frequency;
  }
}

}  // namespace
}  // namespace toryu::solid
