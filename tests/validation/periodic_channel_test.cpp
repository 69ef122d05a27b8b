// Couette and Poiseuille flow from rest: cases/couette, cases/poiseuille against their series (Batchelor
// 1967, section 4.3; Morris, Fox & Zhu 1997).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

constexpr double H = 1.0, nu = 0.1, pi = std::numbers::pi;

double couette(double y, double t) {
  const double U = 0.5;
  double u = U * y / H;
  for (int n = 1; n < 200; ++n)
    u += 2 * U / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::exp(-nu * n * n * pi * pi * t / (H * H)) *
         std::sin(n * pi * y / H);
  return u;
}

double poiseuille(double y, double t) {
  const double F = 0.4;
  double u = F / (2 * nu) * y * (H - y);
  for (int n = 1; n < 200; n += 2)
    u -= 4 * F * H * H / (nu * std::pow(n * pi, 3)) * std::sin(n * pi * y / H) *
         std::exp(-n * n * pi * pi * nu * t / (H * H));
  return u;
}

/// Largest root mean square difference from `exact` at four times, over the largest velocity 0.5 m/s.
double error(const std::string& name, int rows, const std::function<double(double, double)>& exact) {
  WeaklyCompressible solver = FluidCase(name, {"fluid.spacing=" + std::to_string(H / rows)}).solver();
  double largest = 0;
  for (const double t : {0.2, 0.5, 1.0, 2.0}) {
    run_until(solver, t);
    const auto& f = solver.particles();
    double sum = 0;
    for (std::size_t k = 0; k < f.count; ++k) sum += std::pow(f.v[0][k] - exact(f.x[1][k], t), 2);
    largest = std::max(largest, std::sqrt(sum / static_cast<double>(f.count)) / 0.5);
  }
  return largest;
}

void expect_convergence(const std::string& name, const std::function<double(double, double)>& exact,
                        double largest) {
  const double coarse = error(name, 10, exact), fine = error(name, 20, exact);
  ::testing::Test::RecordProperty("error_at_10_and_20", std::to_string(coarse) + " " + std::to_string(fine));
  EXPECT_LT(fine, largest);
  EXPECT_LT(fine, coarse / 1.5);
}

TEST(Couette, FollowsItsSeriesWithoutEnds) {
  expect_convergence("couette", couette, 0.01);
}

TEST(Poiseuille, FollowsItsSeries) {
  expect_convergence("poiseuille", poiseuille, 0.01);
}

}  // namespace
}  // namespace toryu::fluid
