// Each term of a pair loop against sums worked by hand from its formula.
#include <gtest/gtest.h>

#include "fluid_solver/terms/artificial_viscosity.hpp"
#include "fluid_solver/terms/continuity.hpp"
#include "fluid_solver/terms/density_diffusion.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"
#include "fluid_solver/terms/laminar_viscosity.hpp"
#include "fluid_solver/terms/pressure.hpp"
#include "fluid_solver/terms/surface_tension.hpp"
#include "fluid_solver/terms/variable_viscosity.hpp"
#include "fluid_solver/terms/wall_repulsion.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

constexpr double h = 0.013, c_0 = 20;
const CubicSpline kernel(h);

// Five particles without any symmetry: i, three in its reach, one beyond it.
const Point i_point{{0.100, 0.200}, {0.3, -0.2}, 1010, 0.11, 2000, {300, -500}};
const std::vector<Point> others{{{0.109, 0.203}, {-0.1, 0.1}, 1005, 0.10, 1000, {250, -450}},
                                {{0.095, 0.214}, {0.2, 0.5}, 990, 0.12, -500, {310, -520}},
                                {{0.097, 0.193}, {0.4, -0.6}, 1020, 0.09, 3000, {-100, 70}},
                                {{0.127, 0.200}, {9.0, 9.0}, 1100, 0.50, 9000, {1e4, 1e4}}};

auto momentum(const Pressure& term) {
  return [term](auto&&... a) { term.momentum(a...); };
}
auto viscous(const auto& term) {
  return [term](auto&&... a) { term.viscous(a...); };
}
auto diffusion(const auto& term) {
  return [term](auto&&... a) { term.diffusion(a...); };
}

void expect_near(const Vec& value, const Vec& expected) {
  EXPECT_LT((value - expected).norm(), 1e-12 * expected.norm())
      << value.transpose() << " instead of " << expected.transpose();
}

/// m_i a_i + m_j a_j, relative to m_i |a_i|.
double unbalance(const Point& i, const Point& j, const auto& add) {
  const Vec on_i = i.m * first_lane(sum_over(i, {j}, kernel, add).a);
  const Vec on_j = j.m * first_lane(sum_over(j, {i}, kernel, add).a);
  EXPECT_GT(on_i.norm(), 0);
  return (on_i + on_j).norm() / on_i.norm();
}

TEST(Continuity, IsTheSumOfEquation18) {
  const auto rates = sum_over(i_point, others, kernel, [](auto&&... a) { Continuity{}.density(a...); });
  double sum = 0;
  for (const auto& j : others) sum += j.m / j.rho * (i_point.v - j.v).dot(grad_W(i_point.x, j.x, h));
  EXPECT_NEAR(rates.compression[0], sum, 1e-12 * std::abs(sum));
}

TEST(Continuity, RaisesTheDensityOnApproach) {
  const Point i{{0, 0}, {1, 0}}, j{{h, 0}, {-1, 0}};
  EXPECT_GT(sum_over(i, {j}, kernel, [](auto&&... a) { Continuity{}.density(a...); }).compression[0], 0);
}

TEST(Continuity, ThinsByATwentiethAtMostAtAWallWithoutSuction) {
  const auto at_wall = [](const Point& w, double rho, bool suction) {
    const Point i{{0, 0}, {0, 0}, rho};
    return sum_over(i, {w}, kernel, [&](auto&&... a) { Continuity(1000, suction).density_at_wall(a...); })
        .compression[0];
  };
  const double change = 2e-4 * grad_W(Vec(0, 0), Vec(h, 0), h)[0];  // V_w and 1 m/s
  const Point receding{{h, 0}, {1, 0}, 1000, 0.2}, approaching{{h, 0}, {-1, 0}, 1000, 0.2};
  EXPECT_NEAR(at_wall(receding, 951, false), -change, 1e-12 * change);
  EXPECT_EQ(at_wall(receding, 949, false), 0);
  EXPECT_NEAR(at_wall(approaching, 949, false), change, 1e-12 * change);
  EXPECT_NEAR(at_wall(receding, 949, true), -change, 1e-12 * change);
}

TEST(Pressure, IsTheSumOfEquation22) {
  Vec sum = Vec::Zero();
  for (const auto& j : others)
    sum -=
        j.m * (i_point.p / (i_point.rho * i_point.rho) + j.p / (j.rho * j.rho)) * grad_W(i_point.x, j.x, h);
  expect_near(first_lane(sum_over(i_point, others, kernel, momentum(Pressure{})).a), sum);
}

TEST(Pressure, DrivesApartAndKeepsMomentum) {
  const Point i{{0, 0}, {0, 0}, 1000, 0.1, 500}, j{{h, 0.2 * h}, {0, 0}, 1010, 0.2, 900};
  EXPECT_LT(sum_over(i, {j}, kernel, momentum(Pressure{})).a[0][0], 0);
  EXPECT_LT(unbalance(i, j, momentum(Pressure{})), 1e-14);
}

TEST(Pressure, PushesAndPullsAtWallsAsAnywhere) {
  const auto at_wall = [](auto&&... a) { Pressure{}.at_wall(a...); };
  const Point i{{0, 0}, {0, 0}, 1000, 0.1, -500}, w{{h, 0.2 * h}, {0, 0}, 1010, 0.2, -900};
  const double p_rho2 = -500e-6 - 900 / (1010.0 * 1010.0);
  expect_near(first_lane(sum_over(i, {w}, kernel, at_wall).a), -w.m * p_rho2 * grad_W(i.x, w.x, h));
}

TEST(Pressure, NeverPullsAtWallsWithoutSuction) {
  const auto at_wall = [](auto&&... a) { Pressure{false}.at_wall(a...); };
  const Point i{{0, 0}, {0, 0}, 1000, 0.1, -500}, w{{h, 0.2 * h}, {0, 0}, 1000, 0.2, 300};
  Point pushing = w;
  pushing.p = 800;
  EXPECT_EQ(first_lane(sum_over(i, {w}, kernel, at_wall).a), Vec(0, 0));
  expect_near(first_lane(sum_over(i, {pushing}, kernel, at_wall).a), -w.m * 300e-6 * grad_W(i.x, w.x, h));
  EXPECT_LT(unbalance(i, pushing, at_wall), 1e-14);
}

/// Pi_ij as printed in (23)-(24), mended.
double Pi(const Point& i, const Point& j, double A, double B) {
  const Vec x_ij = i.x - j.x;
  const double v_x = (i.v - j.v).dot(x_ij);
  if (v_x >= 0) return 0;
  const double theta = h * v_x / (x_ij.squaredNorm() + 0.01 * h * h);
  return (-A * c_0 * theta + B * theta * theta) / (0.5 * (i.rho + j.rho));
}

TEST(ArtificialViscosity, IsTheSumOfEquation23) {
  const double A = 0.7, B = 1.3;
  Vec sum = Vec::Zero();
  for (const auto& j : others) sum -= j.m * Pi(i_point, j, A, B) * grad_W(i_point.x, j.x, h);
  ASSERT_GT(sum.norm(), 0);
  expect_near(first_lane(sum_over(i_point, others, kernel, viscous(ArtificialViscosityTerm{A, B, h, c_0})).a),
              sum);
}

TEST(ArtificialViscosity, PushesApartWhatApproachesAndLeavesAloneWhatParts) {
  const Point i{{0, 0}, {1, 0}}, j{{h, 0}, {-1, 0}};
  Point i_away = i, j_away = j;
  i_away.v = -i.v;
  j_away.v = -j.v;
  for (const auto& term : {ArtificialViscosityTerm{1, 0, h, c_0}, ArtificialViscosityTerm{0, 1, h, c_0}}) {
    EXPECT_LT(sum_over(i, {j}, kernel, viscous(term)).a[0][0], 0);  // Pi_ij > 0
    EXPECT_EQ(first_lane(sum_over(i_away, {j_away}, kernel, viscous(term)).a), Vec(0, 0));
  }
}

TEST(ArtificialViscosity, KeepsMomentumAndTakesEnergyOut) {
  const ArtificialViscosityTerm term{0.5, 1.0, h, c_0};
  for (const auto& j : {others[0], others[1], others[2]}) {
    if ((i_point.v - j.v).dot(i_point.x - j.x) >= 0) continue;
    EXPECT_LT(unbalance(i_point, j, viscous(term)), 1e-14);
    const Vec on_i = i_point.m * first_lane(sum_over(i_point, {j}, kernel, viscous(term)).a);
    EXPECT_LT(on_i.dot(i_point.v - j.v), 0);
  }
}

TEST(LaminarViscosity, IsTheSumOfMorrisAndOthers) {
  const double mu = 0.8;
  Vec sum = Vec::Zero();
  for (const auto& j : others) {
    const Vec x_ij = i_point.x - j.x;
    sum += j.m * 2 * mu / (i_point.rho * j.rho) * x_ij.dot(grad_W(i_point.x, j.x, h)) / x_ij.squaredNorm() *
           (i_point.v - j.v);
  }
  expect_near(first_lane(sum_over(i_point, others, kernel, viscous(LaminarViscosityTerm{mu})).a), sum);
}

TEST(LaminarViscosity, SlowsThePairAndKeepsMomentum) {
  const LaminarViscosityTerm term{0.8};
  EXPECT_LT(unbalance(i_point, others[0], viscous(term)), 1e-14);
  const Vec a = first_lane(sum_over(i_point, {others[0]}, kernel, viscous(term)).a);
  EXPECT_LT(a.dot(i_point.v - others[0].v), 0);
}

TEST(VariableViscosity, TakesTheHarmonicMeanOfAPair) {
  Point i = i_point;
  i.eta = 3;
  const std::vector<double> etas{1, 3, 6}, means{1.5, 3, 4};
  for (std::size_t k = 0; k < etas.size(); ++k) {
    Point j = others[k];
    j.eta = etas[k];
    expect_near(first_lane(sum_over(i, {j}, kernel, viscous(VariableViscosityTerm{})).a),
                first_lane(sum_over(i, {j}, kernel, viscous(LaminarViscosityTerm{means[k]})).a));
  }
}

TEST(VariableViscosity, AddsTheDivergenceOfTheTransposedGradientAndKeepsMomentum) {
  Point i = i_point;
  i.eta_grad_v << 3, -5, 7, 2;
  Vec sum = Vec::Zero();
  for (Point j : {others[0], others[1], others[2]}) {
    j.eta_grad_v << -4, 1, 6, j.m * 100;
    sum = j.m / (i.rho * j.rho) * (i.eta_grad_v + j.eta_grad_v) * grad_W(i.x, j.x, h);
    const Vec along_v = first_lane(sum_over(i, {j}, kernel, viscous(LaminarViscosityTerm{1})).a);
    expect_near(first_lane(sum_over(i, {j}, kernel, viscous(VariableViscosityTerm{})).a), along_v + sum);
    EXPECT_LT(unbalance(i, j, viscous(VariableViscosityTerm{})), 1e-13);
  }
}

/// Force per volume on the middle of a lattice in the velocity grad_v^T x, where eta = 10 + slope . x.
Vec viscous_force(const Eigen::Matrix2d& grad_v, const Vec& slope) {
  const double d_0 = h / 1.3;
  std::vector<Point> points;
  for (int column = -3; column <= 3; ++column)
    for (int row = -3; row <= 3; ++row) {
      Point point{Vec(column * d_0, row * d_0)};
      point.v = grad_v.transpose() * point.x;
      point.m = 1000 * d_0 * d_0;
      point.eta = 10 + slope.dot(point.x);
      point.eta_grad_v = point.eta * grad_v;
      points.push_back(point);
    }
  const Point middle = points[24];
  return middle.rho * first_lane(sum_over(middle, points, kernel, viscous(VariableViscosityTerm{})).a);
}

TEST(VariableViscosity, IsTheDivergenceOfTheWholeStress) {
  const Vec slope(20, 30);
  Eigen::Matrix2d stretch, shear, rotation;  // (a, b): dv_b/dx_a
  stretch << 2, 0, 0, -2;
  shear << 0, 0, 3, 0;
  rotation << 0, 4, -4, 0;
  for (const auto& grad_v : {stretch, shear}) {
    const Vec exact = (grad_v + grad_v.transpose()) * slope;
    EXPECT_LT((viscous_force(grad_v, slope) - exact).norm(), 0.03 * exact.norm());
  }
  EXPECT_LT(viscous_force(rotation, slope).norm(), 0.03 * (rotation * slope).norm());
}

TEST(DensityDiffusion, IsTheSumOfEquation18) {
  const double factor = 0.1 * h * c_0;
  double renormalised = 0, plain = 0;
  for (const auto& j : others) {
    const Vec x_ij = i_point.x - j.x, grad = grad_W(i_point.x, j.x, h);
    const Vec steep = 2 * (i_point.rho - j.rho) * x_ij / x_ij.squaredNorm();
    plain += factor * j.m / j.rho * steep.dot(grad);
    renormalised += factor * j.m / j.rho * (steep - (i_point.grad_rho + j.grad_rho)).dot(grad);
  }
  const auto sum = [&](const auto& term) {
    return sum_over(i_point, others, kernel, diffusion(term)).diffusion[0];
  };
  EXPECT_NEAR(sum(DensityDiffusionTerm<true>{factor}), renormalised, 1e-12 * std::abs(renormalised));
  EXPECT_NEAR(sum(DensityDiffusionTerm<false>{factor}), plain, 1e-12 * std::abs(plain));
}

TEST(DensityDiffusion, MakesNoMass) {
  // V_i of what i gets from j is minus V_j of what j gets from i: psi_ij = psi_ji.
  const auto term = diffusion(DensityDiffusionTerm<true>{1.0});
  for (const auto& j : {others[0], others[1], others[2]}) {
    const double to_i = i_point.m / i_point.rho * sum_over(i_point, {j}, kernel, term).diffusion[0];
    const double to_j = j.m / j.rho * sum_over(j, {i_point}, kernel, term).diffusion[0];
    EXPECT_NE(to_i, 0);
    EXPECT_NEAR(to_i + to_j, 0, 1e-13 * std::abs(to_i));
  }
}

TEST(DensityDiffusion, FlowsFromDenseToThin) {
  const Point dense{{0, 0}, {0, 0}, 1010}, thin{{h, 0}, {0, 0}, 1000};
  EXPECT_LT(sum_over(dense, {thin}, kernel, diffusion(DensityDiffusionTerm<false>{1.0})).diffusion[0], 0);
}

TEST(EquationOfState, IsEquation3AndItsInverse) {
  const EquationOfState state{1000, 20, 7};
  EXPECT_DOUBLE_EQ(state.p_0(), 1000 * 400 / 7.0);
  EXPECT_EQ(state.pressure(1000.0), 0);
  for (const double rho : {950.0, 999.0, 1001.0, 1100.0}) {
    const double p = 1000 * 400 / 7.0 * (std::pow(rho / 1000, 7) - 1);
    EXPECT_NEAR(state.pressure(rho), p, 1e-12 * std::abs(p));
    EXPECT_NEAR(state.density(p), rho, 1e-12 * rho);
  }
}

TEST(EquationOfState, HoldsTheRestDensityAtTheBackgroundPressure) {
  const EquationOfState state{1000, 20, 7, 300};
  EXPECT_DOUBLE_EQ(state.pressure(1000.0), 300);
  EXPECT_DOUBLE_EQ(state.density(300), 1000);
  EXPECT_NEAR(state.density(state.pressure(980.0)), 980, 1e-10);
}

TEST(WallRepulsion, IsThePrintedForceWithinItsRangeAndKeepsMomentum) {
  const double d_0 = 0.1, r_0 = 0.8 * d_0, B = 2, c = 20, rho_0 = 1000;
  const WallRepulsionTerm term{B * c * c / (rho_0 * d_0 * d_0 * d_0), 1 / r_0};
  const auto add = [&](auto&&... a) { term.at_wall(a...); };
  const Point i{{0.03, 0.04}, {0, 0}, 1000, 9}, w{{0, 0}, {0, 0}, 1000, 10}, beyond{{0.03, -0.05}, {0, 0}};
  const double r = 0.05, a = w.m / (rho_0 * d_0 * d_0) * B * c * c / d_0 * (1 - r / r_0);
  expect_near(first_lane(sum_over(i, {w, beyond}, kernel, add).a), a * Vec(0.6, 0.8));
  EXPECT_LT(unbalance(i, w, add), 1e-14);
}

TEST(SurfaceTension, PullsAPairAsWorkedByHandAndKeepsMomentum) {
  const double H = 0.02;
  const std::array<Point, 2> points{{{{0, 0}, {0, 0}, 1000, 0.2}, {{0.006, 0.008}, {0, 0}, 1000, 0.1}}};
  std::array<Eigen::Matrix2d, 2> stress;
  stress[0] << 2, -1, -1, 3;
  stress[1] << 1, 2, 2, -4;
  const auto on = [&](int i, int j) {
    TensorField T;
    resize(T, 1);
    for (int a = 0; a < dim; ++a) set(T[a], 0, stress[j].row(a));
    TensorLanes T_i;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b) T_i[a][b] = stress[i](a, b);
    const SurfaceTensionPair force{SmoothKernel(H), T_i, pointers(T)};
    return first_lane(sum_over(points[i], {points[j]}, kernel, [&](auto&&... a) { force.momentum(a...); }).a);
  };
  // r = H/2, so gradS = -24/(pi H^4) 0.75^2 x_ij; (T_i + T_j) x_ij = (3 1; 1 -1) (-0.006, -0.008)
  const double slope = -24 * 0.5625 / (std::numbers::pi * H * H * H * H);
  expect_near(on(0, 1), 0.1 * slope * Vec(-0.026, 0.002));
  expect_near(on(1, 0), 0.2 * slope * Vec(0.026, -0.002));
}

TEST(SurfaceTension, IsAStressAlongTheSurfaceAlone) {
  const SurfaceTensionForce force(7e6, 1, 0.02);
  const auto T = force.stress({Lanes(3.0), Lanes(4.0)}, Lanes(1000.0));  // |n| - n_0 = 4
  const double expected[2][2] = {{28 * 0.64, -28 * 0.48}, {-28 * 0.48, 28 * 0.36}};
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b) EXPECT_NEAR(T[a][b][0], expected[a][b], 1e-12);
  EXPECT_EQ(force.stress({Lanes(0.6), Lanes(0.7)}, Lanes(1000.0))[0][0][0], 0) << "below n_0";
}

/// A block of fluid at rest, of which surface tension alone takes hold.
Setting block_under_tension(double sigma) {
  Setting s = empty_space();
  s.parameters.density_diffusion.reset();
  s.parameters.artificial_viscosity.reset();
  s.parameters.kernel = KernelForm::wendland_c2;
  s.parameters.smoothing_ratio = 1.8;
  s.parameters.surface_tension = SurfaceTension{sigma};
  s.parameters.regions = {{"block", {Vec(-0.8, -0.6), Vec(0.8, 0.6)}, Vec::Zero()}};
  return s;
}

TEST(SurfaceTension, PullsTheHalvesOfABlockTogetherByTwiceSigmaAndLeavesTheInsideAlone) {
  const double sigma = 3;
  for (const double ratio : {1.5, 1.8, 2.0}) {
    Setting setting = block_under_tension(sigma);
    setting.parameters.smoothing_ratio = ratio;
    WeaklyCompressible solver = setting.solver();
    solver.advance(1e-9);
    const auto& f = solver.particles();
    double left = 0, largest = 0, inside = 0;
    for (std::size_t i = 0; i < f.count; ++i) {
      const double a = at(f.a, i).norm();
      if (at(f.x, i)[0] < 0) left += f.m[i] * f.a[0][i];
      largest = std::max(largest, a);
      if (at(f.x, i).cwiseAbs().maxCoeff() < 0.15) inside = std::max(inside, a);
    }
    EXPECT_NEAR(left, 2 * sigma, 1e-6) << ratio;  // a surface above, one below
    EXPECT_LT(inside, 1e-10 * largest) << ratio;
  }
}

TEST(SurfaceTension, KeepsTheMomentumOfParticlesInDisorder) {
  Setting setting = block_under_tension(3);
  setting.parameters.start_disorder = 0.3;
  WeaklyCompressible solver = setting.solver();
  solver.advance(1e-9);
  const auto& f = solver.particles();
  Vec sum = Vec::Zero();
  double sizes = 0;
  for (std::size_t i = 0; i < f.count; ++i) {
    sum += f.m[i] * at(f.a, i);
    sizes += f.m[i] * at(f.a, i).norm();
  }
  EXPECT_GT(sizes, 3);
  EXPECT_LT(sum.norm(), 1e-14 * sizes);
}

TEST(EquationOfState, HasTheSoundSpeedAsTheSlopeOfPressure) {
  for (const int gamma : {1, 7}) {
    const EquationOfState state{1000, 20, gamma};
    EXPECT_NEAR((state.pressure(1000.001) - state.pressure(999.999)) / 0.002, 400, 1e-4);
  }
}

}  // namespace
}  // namespace toryu::fluid
