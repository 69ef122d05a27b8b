// A medium pressed through a nozzle that is read from a drawing: its pressure drop.
#include <gtest/gtest.h>

#include "common/scene/outline.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// Drop by finite elements, pistons where they are at 0.25 s (cases/nozzle/README.md) [Pa].
constexpr double finite_elements = 506.9e3;
constexpr double probe = 0.0096, middle = 0.003, flux = 0.01 * 0.006,
                 viscosity = 1000;  // [m], [m2/s], [Pa s]

/// Half the height of the passage between the outline of the lower half and the axis [m].
double half_height(const Outline& half, double x) {
  return (1 - half.shares_inside({x, -0.001}, {x, middle}).back().second) * (middle + 0.001);
}

/// Drop between the probes by lubrication theory to the second order in the slope of the walls,
/// 3/2 mu q int (1 + 6/5 a'^2)/a^3 dx (cases/nozzle/README.md) [Pa].
double drop_by_lubrication(const Outline& half) {
  constexpr int steps = 4000;
  constexpr double dx = 2 * probe / steps;
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    const double x = -probe + (n + 0.5) * dx;
    const double a = half_height(half, x);
    const double slope = (half_height(half, x + 0.5 * dx) - half_height(half, x - 0.5 * dx)) / dx;
    sum += (1 + 1.2 * slope * slope) / (a * a * a) * dx;
  }
  return 1.5 * viscosity * flux * sum;
}

TEST(Nozzle, HasThePressureDropOfItsDrawing) {
  const FluidCase nozzle("nozzle");
  const Outline& half = *nozzle.scene.walls[0].box.outline;
  const double expected = drop_by_lubrication(half);
  EXPECT_NEAR(expected, 511.5e3, 0.5e3);  // of the spline itself
  WeaklyCompressible solver = nozzle.solver();
  double drop = 0;
  int samples = 0;
  for (double time = 0.2; time < 0.3; time += 0.004, ++samples) {
    run_until(solver, time);
    const auto& f = solver.particles();
    double sum[2] = {0, 0};
    int count[2] = {0, 0};
    for (std::size_t i = 0; i < f.count; ++i)
      for (const int side : {0, 1})
        if (std::abs(f.x[0][i] - (side == 0 ? -probe : probe)) < 0.0005 &&
            std::abs(f.x[1][i] - middle) < 0.0005)
          sum[side] += f.p[i], ++count[side];
    drop += sum[0] / count[0] - sum[1] / count[1];
  }
  RecordProperty("drop_over_finite_elements", std::to_string(drop / samples / finite_elements));
  EXPECT_NEAR(drop / samples / finite_elements, 1, 0.015) << "+3.2 % by sums that are not consistent";
}

}  // namespace
}  // namespace toryu::fluid
