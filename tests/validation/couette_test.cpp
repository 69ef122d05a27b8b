// Flow between a wall that starts to move and one at rest. The difference from the final profile U y/H is a
// sum of sine waves, the first of which decays as exp(-nu pi^2 t/H^2) (Batchelor 1967, section 4.3): its
// decay is the viscosity, whatever the others do.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace couette_test {

constexpr double H = 1.0, nu = 0.1, U = 0.01, pi = std::numbers::pi;

/// A channel four times as long as wide; its open ends are not seen in the middle.
WeaklyCompressible channel(int rows) {
  Parameters p;
  p.density = 1000;
  p.sound_speed = 5;
  p.spacing = H / rows;
  p.laminar_viscosity = LaminarViscosity{p.density * nu};
  p.density_diffusion = DensityDiffusion{};
  p.regions = {{"channel", {Vec(0, 0), Vec(4 * H, H)}, Vec::Zero()}};
  Scene scene;
  scene.domain = {Vec(-2, -1), Vec(6, 2)};
  const double depth = 3 * p.spacing;
  scene.walls = {{"still", {Vec(-H, -depth), Vec(5 * H, 0)}, {}},
                 {"moving", {Vec(-H, H), Vec(5 * H, H + depth)}, Motion{{{0.0, U, 0.0}}}}};
  return WeaklyCompressible(p, scene);
}

template <class Visit>
void in_the_middle(const WeaklyCompressible& solver, Visit&& visit) {
  const auto& f = solver.particles();
  for (std::size_t k = 0; k < f.count; ++k)
    if (std::abs(f.x[0][k] - 2 * H) < 0.25 * H) visit(f.x[1][k], f.v[0][k]);
}

/// The amplitude of the first sine wave.
double first_wave(const WeaklyCompressible& solver) {
  double product = 0, square = 0;
  in_the_middle(solver, [&](double y, double u) {
    const double wave = std::sin(pi * y / H);
    product += (u - U * y / H) * wave;
    square += wave * wave;
  });
  return product / square;
}

double profile(double y, double t) {
  double u = U * y / H;
  for (int n = 1; n < 200; ++n)
    u += 2 * U / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::exp(-nu * n * n * pi * pi * t / (H * H)) *
         std::sin(n * pi * y / H);
  return u;
}

TEST(Couette, HasTheViscosityThatWasAskedFor) {
  WeaklyCompressible solver = channel(20);
  run_until(solver, 1.0);
  const double before = first_wave(solver);
  run_until(solver, 2.5);
  const double measured = std::log(before / first_wave(solver)) * H * H / (pi * pi * 1.5);
  RecordProperty("measured_over_nominal", std::to_string(measured / nu));
  EXPECT_NEAR(measured / nu, 1.0, 0.02);
}

TEST(Couette, FollowsTheExactProfile) {
  WeaklyCompressible solver = channel(20);
  for (const double t : {0.2, 0.5, 1.0, 2.0}) {
    run_until(solver, t);
    double largest = 0;
    in_the_middle(solver,
                  [&](double y, double u) { largest = std::max(largest, std::abs(u - profile(y, t))); });
    EXPECT_LT(largest, 0.02 * U) << "t = " << t;
  }
}

}  // namespace couette_test
}  // namespace toryu::fluid
