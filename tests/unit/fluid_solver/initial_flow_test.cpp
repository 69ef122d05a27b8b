// Flows to start with: volume is kept, and the pressure is the one that belongs to them.
#include "fluid_solver/initial_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace toryu::fluid {
namespace {

constexpr double step = 1e-4;

/// (a, b): dv_b/dx_a by differences.
Mat velocity_gradient(const InitialFlow& flow, const Vec& x) {
  Mat gradient;
  for (int a = 0; a < dim; ++a) {
    const Vec to = step * Vec::Unit(a);
    gradient.row(a) = (velocity(flow, x + to) - velocity(flow, x - to)) / (2 * step);
  }
  return gradient;
}

Vec pressure_gradient(const InitialFlow& flow, const Box& body, double rate, const Vec& x) {
  Vec gradient;
  for (int a = 0; a < dim; ++a) {
    const Vec to = step * Vec::Unit(a);
    gradient[a] =
        (pressure_over_density(flow, body, rate, x + to) - pressure_over_density(flow, body, rate, x - to)) /
        (2 * step);
  }
  return gradient;
}

const Box body{Vec(-1, -1), Vec(1, 1)};
const Vec centre(0.3, -0.2);
const std::vector<Vec> places{{0.1, 0.2}, {-0.4, 0.33}, {0.7, -0.6}};

TEST(InitialFlow, KeepsTheVolume) {
  for (const auto profile :
       {FlowProfile::taylor_green, FlowProfile::rotation, FlowProfile::strain, FlowProfile::standing_wave})
    for (const Vec& x : places) {
      const InitialFlow flow{profile, 0.7, 1.9, 0.8, centre};
      EXPECT_NEAR(velocity_gradient(flow, x).trace(), 0, 1e-6 * velocity_gradient(flow, x).norm())
          << static_cast<int>(profile);
      EXPECT_GT(velocity(flow, x).norm(), 0.05);
    }
}

TEST(TaylorGreen, IsInBalanceWithItsPressure) {
  const InitialFlow flow{FlowProfile::taylor_green, 0.7, 1.9, 0, centre};
  for (const Vec& x : places) {
    const Vec inertia = velocity_gradient(flow, x).transpose() * velocity(flow, x);
    EXPECT_GT(inertia.norm(), 0.01);
    EXPECT_LT((inertia + pressure_gradient(flow, body, 0, x)).norm(), 1e-6 * inertia.norm());
  }
}

TEST(TaylorGreen, DecaysAsItsViscousForce) {
  // dv/dt = nu laplacian v = -2 nu k^2 v
  const InitialFlow flow{FlowProfile::taylor_green, 0.7, 1.9, 0, centre};
  const Vec x = places[0], v = velocity(flow, x);
  Vec laplacian = -4 * v;
  for (const Vec& to : {Vec(step, 0), Vec(-step, 0), Vec(0, step), Vec(0, -step)})
    laplacian += velocity(flow, x + to);
  laplacian /= step * step;
  const double nu = 0.03;
  EXPECT_LT((nu * laplacian - std::log(decay(flow, nu, 1)) * v).norm(), 1e-5 * v.norm());
}

TEST(Strain, IsInBalanceWithThePressureOfTheDropAndItsForce) {
  const InitialFlow flow{FlowProfile::strain, 0.7, 1.0, 0, Vec(0, 0)};
  const double rate = 1.3;
  for (const Vec& x : places) {
    const Vec inertia = velocity_gradient(flow, x).transpose() * velocity(flow, x);
    EXPECT_LT((inertia + pressure_gradient(flow, body, rate, x) + rate * rate * x).norm(), 1e-7);
  }
  EXPECT_NEAR(pressure_over_density(flow, body, rate, Vec(0.6, 0.8)), 0, 1e-15);  // on the surface
}

TEST(Rotation, HasThePressureOfATurningSquare) {
  // laplacian p/rho = 2 w^2; in the middle -0.14734 w^2 L^2 (Le Touze et al. 2013), side L = 2
  const InitialFlow flow{FlowProfile::rotation, 3.0, 1.0, 0, Vec(0, 0)};
  const double w = 3.0, h = 0.05;
  const auto p = [&](double x, double y) { return pressure_over_density(flow, body, 0, Vec(x, y)); };
  EXPECT_NEAR(p(0, 0) / (w * w * 4), -0.14734, 1e-4);
  EXPECT_NEAR(p(1, 0.3), 0, 1e-12);
  const double laplacian = (p(h, 0) + p(-h, 0) + p(0, h) + p(0, -h) - 4 * p(0, 0)) / (h * h);
  EXPECT_NEAR(laplacian, 2 * w * w, 0.02 * w * w);
  EXPECT_EQ(velocity(flow, Vec(0, 1)), Vec(3, 0));
}

TEST(StandingWave, TouchesTheFloorAndMovesTheSurface) {
  const InitialFlow flow{FlowProfile::standing_wave, 0.7, 1.9, 0.8, centre};
  EXPECT_NEAR(velocity(flow, centre)[1], 0.7, 1e-15);
  EXPECT_NEAR(velocity(flow, centre + Vec(0.4, -0.8))[1], 0, 1e-15);
  const Mat gradient = velocity_gradient(flow, places[1]);
  EXPECT_NEAR(gradient(0, 1), gradient(1, 0), 1e-6 * gradient.norm());  // no vorticity
}

}  // namespace
}  // namespace toryu::fluid
