// Media that are not Newtonian: laws, velocity gradient, what walls take, and the solver with them.
#include "fluid_solver/terms/rheology.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <numeric>

#include "fluid_solver/terms/velocity_gradient.hpp"
#include "fluid_solver/wall_extrapolation.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace rheology_test {

TEST(PowerLaw, IsConsistencyTimesAPowerOfTheShearRate) {
  const PowerLaw thinning{2.0, 0.5, 0.01, 100};
  EXPECT_DOUBLE_EQ(viscosity(thinning, 4.0), 1.0);   // 2 * 4^-0.5
  EXPECT_DOUBLE_EQ(viscosity(thinning, 0.25), 4.0);  // 2 * 0.25^-0.5
  const PowerLaw thickening{2.0, 1.5, 0.01, 100};
  EXPECT_DOUBLE_EQ(viscosity(thickening, 4.0), 4.0);  // 2 * 4^0.5
  const PowerLaw newtonian{2.0, 1.0, 0.01, 100};
  for (const double gdot : {0.0, 1e-9, 3.0, 1e9}) EXPECT_DOUBLE_EQ(viscosity(newtonian, gdot), 2.0);
}

TEST(PowerLaw, KeepsWithinItsBounds) {
  const PowerLaw thinning{2.0, 0.5, 0.01, 100}, thickening{2.0, 1.5, 0.01, 100};
  EXPECT_EQ(viscosity(thinning, 0.0), 100);
  EXPECT_EQ(viscosity(thinning, 1e6), 0.01);
  EXPECT_EQ(viscosity(thickening, 0.0), 0.01);
  EXPECT_EQ(viscosity(thickening, 1e6), 100);
}

TEST(HerschelBulkley, IsAPowerLawAboveAYieldStress) {
  const HerschelBulkley law{{2.0, 0.5, 0.01, 1e4}, 6.0, 50.0};
  EXPECT_DOUBLE_EQ(viscosity(law, 4.0), 6.0 / 4 + 2 * 0.5);  // t_r gdot = 200: nothing is left of exp
  EXPECT_NEAR(viscosity(law, 0.02), 6 * (1 - std::exp(-1.0)) / 0.02 + 2 / std::sqrt(0.02), 1e-9);
  const HerschelBulkley bingham{{2.0, 1.0, 0.01, 1e4}, 6.0, 50.0};
  EXPECT_DOUBLE_EQ(viscosity(bingham, 0.0), 6 * 50 + 2);  // creeps at t_r tau_y
  EXPECT_NEAR(viscosity(bingham, 1e-12), 6 * 50 + 2, 1e-6);
  EXPECT_NEAR(viscosity(bingham, 1e9), 2, 1e-8);
  const HerschelBulkley without{{2.0, 0.5, 0.01, 100}, 0.0, 50.0};
  for (const double gdot : {0.0, 1e-3, 1.0, 1e6})
    EXPECT_DOUBLE_EQ(viscosity(without, gdot), viscosity(PowerLaw{2.0, 0.5, 0.01, 100}, gdot));
}

TEST(HerschelBulkley, KeepsWithinItsBounds) {
  const HerschelBulkley law{{2.0, 0.5, 0.01, 100}, 6.0, 50.0};
  EXPECT_EQ(viscosity(law, 0.0), 100);
  EXPECT_EQ(viscosity(law, 1e-3), 100);
  EXPECT_EQ(viscosity(law, 1e7), 0.01);
}

TEST(Carreau, GoesFromOnePlateauToTheOther) {
  const Carreau law{10, 1, 2, 0.5};
  EXPECT_DOUBLE_EQ(viscosity(law, 0.0), 10);
  EXPECT_NEAR(viscosity(law, std::sqrt(15.0) / 2), 5.5, 1e-14);  // 1 + 9 * 16^-0.25
  EXPECT_NEAR(viscosity(law, 1e12), 1, 1e-5);
  EXPECT_DOUBLE_EQ(viscosity(Carreau{10, 1, 2, 1.0}, 7.0), 10);
}

TEST(Rheology, TreatsEachLaneByItself) {
  Lanes gdot;
  for (std::size_t lane = 0; lane < lane_count; ++lane) gdot.value[lane] = 0.5 + static_cast<double>(lane);
  const Carreau law{10, 1, 2, 0.5};
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    EXPECT_DOUBLE_EQ(viscosity(law, gdot)[lane], viscosity(law, gdot[lane]));
}

// --- shear rate ---

constexpr double d_0 = 0.1;
const CubicSpline kernel(1.3 * d_0);

/// Neighbours of the origin without symmetry, in the velocity field v_0 + A x; `half`: none above.
std::vector<Point> neighbours(const Eigen::Matrix2d& A, bool half = false) {
  std::vector<Point> points;
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return 0.6 * d_0 * (state / 4294967296.0 - 0.5);
  };
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= (half ? 0 : 3); ++b) {
      if (a == 0 && b == 0) continue;
      Point point{Vec(a * d_0 + noise(), b * d_0 + noise())};
      point.v = Vec(5, -7) + A * point.x;
      point.m = 1000 * d_0 * d_0;
      points.push_back(point);
    }
  return points;
}

TensorLanes gradient(const std::vector<Point>& points) {
  const FewSources sources(points);
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  VelocityGradient grad_v({Lanes(0), Lanes(0)}, {Lanes(5), Lanes(-7)});
  const ShiftedNeighbours near{Vec::Zero(), all};
  grad_v.add(sources.view(), std::span(&near, 1), kernel);
  return grad_v.value();
}

double shear_rate_of(const Eigen::Matrix2d& A) {
  return shear_rate(gradient(neighbours(A)))[0];
}

const Eigen::Matrix2d shear{{0, 3}, {0, 0}}, rotation{{0, 4}, {-4, 0}}, stretch{{2, 0}, {0, -2}},
    all_kinds{{1, 5}, {-2, 3}};

TEST(VelocityGradient, IsExactInALinearVelocityEvenIfNeighboursAreOneSided) {
  for (const bool half : {false, true}) {
    const TensorLanes grad_v = gradient(neighbours(all_kinds, half));
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b) EXPECT_NEAR(grad_v[a][b][0], all_kinds(b, a), 1e-12) << a << b;
  }
}

TEST(VelocityGradient, OfALonelyParticleIsZero) {
  auto one = neighbours(all_kinds);
  one.resize(1);
  EXPECT_EQ(shear_rate(gradient(one))[0], 0);
  EXPECT_EQ(shear_rate(gradient({}))[0], 0);
}

TEST(ShearRate, IsTheRootOfTwiceTheSquareOfTheStrainRate) {
  EXPECT_NEAR(shear_rate_of(shear), 3, 1e-12);
  EXPECT_NEAR(shear_rate_of(-shear), 3, 1e-12);
  EXPECT_NEAR(shear_rate_of(rotation), 0, 1e-6);
  EXPECT_NEAR(shear_rate_of(stretch), 4, 1e-12);                  // sqrt(2 (4 + 4))
  EXPECT_NEAR(shear_rate_of(all_kinds), std::sqrt(29.0), 1e-12);  // D = (1, 1.5; 1.5, 3)
}

// --- walls ---

TEST(WallViscosity, IsTheKernelMeanOfTheFluids) {
  Boundary wall;
  const Vec place(0, 0);
  wall.place({place, Vec(5, 5)}, {d_0 * d_0, d_0 * d_0}, 1000, 0.3);
  wall.eta.resize(padded(wall.count), -1);
  resize(wall.eta_grad_v, padded(wall.count));
  Particles f;
  f.count = 2;
  resize(f.x, padded(2), 1e3);
  f.eta.assign(padded(2), 0.0);
  set(f.x, 0, Vec(0, 1.3 * d_0));   // s = 1, W = W(0)/4 by (11)
  set(f.x, 1, Vec(0, 0.65 * d_0));  // s = 1/2, W = 0.71875 W(0)
  f.eta[0] = 8;
  f.eta[1] = 2;
  resize(f.eta_grad_v, padded(2));
  f.eta_grad_v[0][1][0] = 5;
  StripOrder strips(0.3);
  strips.index(f.x[0], f.count);
  wall.list_for_wall.build(wall.x, wall.count, f.x, strips, 1.1 * kernel.support());
#pragma omp parallel
  extrapolate_viscosity(wall, f, kernel);
  const std::size_t k = wall.id[0] == 0 ? 0 : 1;
  EXPECT_NEAR(wall.eta[k], (8 * 0.25 + 2 * 0.71875) / 0.96875, 1e-12);
  EXPECT_NEAR(wall.eta_grad_v[0][1][k], 5 * 0.25 / 0.96875, 1e-12);
  EXPECT_EQ(wall.eta_grad_v[1][0][k], 0);
}

TEST(WallPolymerStress, IsTheKernelMeanOrTheLineThroughTheFace) {
  Boundary wall;
  const Vec place(0, -0.5 * d_0);
  wall.place({place, Vec(5, 5)}, {d_0 * d_0, d_0 * d_0}, 1000, 0.3);
  Particles f;
  f.count = 2;
  resize(f.x, padded(2), 1e3);
  set(f.x, 0, Vec(0, 0.5 * d_0));
  set(f.x, 1, Vec(0, 1.5 * d_0));
  resize(f.polymer_stress, padded(2));
  f.polymer_stress.xx[0] = 8, f.polymer_stress.xx[1] = 2;
  f.polymer_stress.xy[0] = -4, f.polymer_stress.xy[1] = -3;
  StripOrder strips(0.3);
  strips.index(f.x[0], f.count);
  const auto found = [&] {
    resize(wall.polymer_stress, padded(wall.count));
    wall.list_for_wall.build(wall.x, wall.count, f.x, strips, 1.1 * kernel.support());
#pragma omp parallel
    extrapolate_polymer_stress(wall, f, kernel);
    const std::size_t k = wall.id[0] == 0 ? 0 : 1;
    return Symmetric<double>{wall.polymer_stress.xx[k], wall.polymer_stress.yy[k], wall.polymer_stress.xy[k]};
  };
  // W at 1/1.3 and 2/1.3 of h by (11)
  const double s = 1 / 1.3, near = 1 - 1.5 * s * s + 0.75 * s * s * s, far = 0.25 * std::pow(2 - 2 * s, 3);
  EXPECT_NEAR(found().xx, (8 * near + 2 * far) / (near + far), 1e-10);
  EXPECT_NEAR(found().xy, -(4 * near + 3 * far) / (near + far), 1e-10);
  EXPECT_EQ(found().yy, 0);
  wall.know_faces({{Vec(1, 0.5 * d_0), Vec(1, 1)}, {Vec(1, 1), Vec(1, 1)}});
  // the line through distances 0.5 and 1.5 d_0, at -0.5 d_0, with 0.005 d_0^2 beside their variance
  const double share = far / (near + far), variance = share * (1 - share), middle = 0.5 + share;
  const auto line = [&](double first, double second) {
    const double slope = (second - first) * variance / (variance + 0.005);
    return first + share * (second - first) - slope * (0.5 + middle);
  };
  EXPECT_NEAR(found().xx, line(8, 2), 1e-10);
  EXPECT_NEAR(found().xy, line(-4, -3), 1e-10);
}

// --- the solver ---

Setting sheared_column(std::optional<PowerLaw> law) {
  Setting setting = collapsing_column();
  setting.parameters.power_law = law;
  return setting;
}

TEST(FluidOfExponentOne, HasOneViscosityAndFlowsAsANewtonianOne) {
  WeaklyCompressible law = sheared_column(PowerLaw{20, 1.0, 0.1, 200}).solver();
  Setting newtonian = sheared_column({});
  newtonian.parameters.laminar_viscosity = LaminarViscosity{20};
  WeaklyCompressible same = newtonian.solver();
  run_until(law, 0.05);
  run_until(same, 0.05);
  const auto& f = law.particles();
  for (std::size_t i = 0; i < f.count; ++i) EXPECT_DOUBLE_EQ(f.eta[i], 20);
  // div(eta grad v^T) acts where the medium is compressed, and at the surface
  const double path = largest_difference(positions(same), positions(sheared_column({}).solver()));
  EXPECT_GT(path, 0.005);
  EXPECT_LT(largest_difference(positions(law), positions(same)), 0.05 * path);
}

TEST(ThinningFluid, HasTheViscosityOfItsShearRateAndShowsBoth) {
  const PowerLaw law{20, 0.5, 0.1, 200};
  WeaklyCompressible solver = sheared_column(law).solver();
  run_until(solver, 0.05);
  const auto& f = solver.particles();
  const auto frame = solver.frame();
  ASSERT_EQ(frame.fields.size(), 6u);
  EXPECT_EQ(frame.fields[4].name, "viscosity");
  EXPECT_EQ(frame.fields[5].name, "shear_rate");
  double largest = 0;
  for (std::size_t i = 0; i < f.count; ++i) {
    EXPECT_DOUBLE_EQ(f.eta[i], viscosity(law, f.gdot[i]));
    EXPECT_EQ(frame.fields[4].values[i], f.eta[i]);
    EXPECT_EQ(frame.fields[5].values[i], f.gdot[i]);
    largest = std::max(largest, f.gdot[i]);
  }
  EXPECT_GT(largest, 1);
}

TEST(ThinningFluid, GivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<Vec>> x;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    WeaklyCompressible solver = sheared_column(PowerLaw{20, 0.5, 0.1, 200}).solver();
    run_until(solver, 0.02);
    x.push_back(positions(solver));
  }
  omp_set_num_threads(1);
  EXPECT_EQ(x[0], x[1]);
}

TEST(ThinningFluid, TakesTheStepOfItsLargestViscosity) {
  WeaklyCompressible solver = sheared_column(PowerLaw{20, 0.5, 0.1, 2e4}).solver();
  const double h = 0.065;
  const auto limit = [&](double eta) { return 0.125 * h * h * 1000 / eta; };
  // with the artificial viscosity's 0.049 alpha h c_0 beside it
  const double artificial = 1000 * 0.049 * 0.05 * h * 20;
  EXPECT_NEAR(solver.time_step_limit(), limit(2e4 + artificial), 1e-12);  // at rest
  EXPECT_EQ(solver.time_step_rule(), "viscous");
  run_until(solver, 0.01);
  const auto& f = solver.particles();
  const double largest = *std::max_element(f.eta.begin(), f.eta.begin() + static_cast<long>(f.count));
  EXPECT_LT(largest, 2e4);
  EXPECT_NEAR(solver.time_step_limit(), limit(largest + artificial), 1e-12);
}

}  // namespace rheology_test
}  // namespace toryu::fluid
