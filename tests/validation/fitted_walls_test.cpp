// Flows along walls whose velocity and viscosity are fitted (wall_extrapolation.hpp): cases/lid_driven_cavity
// and cases/poiseuille/power_law.toml.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "fluid_solver/observers.hpp"
#include "tests/validation/channel.hpp"

namespace toryu::fluid {
namespace {

/// Velocity at `place` by a fit of the second order to the particles within 2.6 spacings.
Vec velocity_at(const Vec& place, const Particles& f, double spacing) {
  const double reach = 2.6 * spacing;
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < f.count; ++i)
    if ((at(f.x, i) - place).norm() < reach) near.push_back(i);
  Eigen::MatrixXd rows(near.size(), 6), values(near.size(), 2);
  for (std::size_t k = 0; k < near.size(); ++k) {
    const Vec d = (at(f.x, near[k]) - place) / spacing;
    const double weight = 1 - d.norm() * spacing / reach;
    const auto row = static_cast<Eigen::Index>(k);
    rows.row(row) << 1, d[0], d[1], d[0] * d[0], d[0] * d[1], d[1] * d[1];
    rows.row(row) *= weight;
    values.row(row) = weight * at(f.v, near[k]).transpose();
  }
  return rows.colPivHouseholderQr().solve(values).row(0).transpose();
}

/// Mean velocities over time at places along a centre line.
struct Line {
  std::vector<Vec> places;
  std::vector<double> sum;
  int component;
  Line(int of, double from, double to) : component(of) {
    for (double s = from; s < to; s += 0.01) places.push_back(of == 0 ? Vec(0.5, s) : Vec(s, 0.5));
    sum.assign(places.size(), 0.0);
  }
  void add(const Particles& f, double spacing) {
    for (std::size_t k = 0; k < places.size(); ++k) sum[k] += velocity_at(places[k], f, spacing)[component];
  }
};

struct Extremes3 {
  double u_min, v_max, v_min;
};
/// Means of `samples` over the time from 10 s to 16 s.
Extremes3 cavity(const std::vector<std::string>& overrides) {
  const FluidCase the_case("lid_driven_cavity", overrides);
  WeaklyCompressible solver = the_case.solver();
  Line u(0, 0.3, 0.7), v_rises(1, 0.12, 0.35), v_falls(1, 0.7, 0.92);
  constexpr int samples = 40;
  for (int n = 1; n <= samples; ++n) {
    run_until(solver, 10 + 0.15 * n);
    for (Line* line : {&u, &v_rises, &v_falls}) line->add(solver.particles(), the_case.parameters.spacing);
  }
  return {*std::min_element(u.sum.begin(), u.sum.end()) / samples,
          *std::max_element(v_rises.sum.begin(), v_rises.sum.end()) / samples,
          *std::min_element(v_falls.sum.begin(), v_falls.sum.end()) / samples};
}

// Converged at Re 100, by finite differences that are extrapolated (README.md of the case).
constexpr Extremes3 converged{-0.2140, 0.1796, -0.2538};

TEST(LidDrivenCavity, TurnsAsTheConvergedFlowDoes) {
  const Extremes3 found = cavity({"fluid.spacing=0.05"});
  RecordProperty("u_min_v_max_v_min", std::to_string(found.u_min) + " " + std::to_string(found.v_max) + " " +
                                          std::to_string(found.v_min));
  EXPECT_NEAR(found.u_min / converged.u_min, 1.0, 0.05);
  EXPECT_NEAR(found.v_max / converged.v_max, 1.0, 0.08);
  EXPECT_NEAR(found.v_min / converged.v_min, 1.0, 0.06);
}

/// Flow rate of the power law over the exact one, at 9 s.
double flow_over_exact(int rows, const std::string& exponent, const std::string& consistency) {
  const FluidCase the_case("poiseuille/power_law.toml", {"fluid.spacing=" + std::to_string(1.0 / rows),
                                                         "fluid.power_law.exponent=" + exponent,
                                                         "fluid.power_law.consistency=" + consistency});
  WeaklyCompressible solver = the_case.solver();
  double sum = 0;
  constexpr int samples = 20;
  for (int n = 1; n <= samples; ++n) {
    run_until(solver, 8 + 0.05 * n);
    sum += flow_rate(solver.particles(), *the_case.parameters.observers.front().box, Axis::x) / samples;
  }
  double low = 0.1, high = 1;  // the mean velocity whose wall stress is rho F H/2
  while (high - low > 1e-9) {
    const double mean = 0.5 * (low + high);
    (DevelopedFlow(viscosity_of(the_case.parameters), 1, mean).wall_stress() < 200 ? low : high) = mean;
  }
  return sum / low;
}

TEST(PowerLawBetweenFittedWalls, HasItsFlowRate) {
  const double thins = flow_over_exact(10, "0.6", "117") - 1,
               thickens = flow_over_exact(10, "1.4", "87.2") - 1;
  const double fine = flow_over_exact(20, "1.4", "87.2") - 1;
  RecordProperty("at_10_n_06_at_10_and_20_n_14",
                 std::to_string(thins) + " " + std::to_string(thickens) + " " + std::to_string(fine));
  EXPECT_NEAR(thins, 0.0, 0.02);
  EXPECT_NEAR(thickens, 0.0, 0.025);
  EXPECT_NEAR(fine, 0.0, 0.01);
  EXPECT_LT(std::abs(fine), std::abs(thickens) / 3) << "of the second order";
}

}  // namespace
}  // namespace toryu::fluid
