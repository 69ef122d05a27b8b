// Viscoelastic media: the rate of the log-conformation, stress and energy against sums by hand, closed forms
// and Eigen's decompositions; the force; the solver with them.
#include "fluid_solver/terms/viscoelasticity.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "fluid_solver/weakly_compressible/polymer.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace viscoelasticity_test {

using Matrix = Eigen::Matrix2d;

Matrix full(const Symmetric<double>& tensor) {
  return Matrix{{tensor.xx, tensor.xy}, {tensor.xy, tensor.yy}};
}
Symmetric<double> symmetric(const Matrix& m) {
  return {m(0, 0), m(1, 1), m(0, 1)};
}
Matrix of_eigenvalues(const Matrix& m, double (*function)(double)) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(m);
  const Eigen::Vector2d values = solver.eigenvalues().unaryExpr(function);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}
Matrix exponential(const Matrix& m) {
  return of_eigenvalues(m, [](double s) { return std::exp(s); });
}
Matrix logarithm(const Matrix& m) {
  return of_eigenvalues(m, [](double s) { return std::log(s); });
}
/// The code's [a][b] = dv_b/dx_a of L_ab = dv_a/dx_b.
VelocityGradientOfOne gradient(const Matrix& L) {
  return {{{L(0, 0), L(1, 0)}, {L(0, 1), L(1, 1)}}};
}

/// psi after `time` in steps of the second order under the velocity gradient L.
Symmetric<double> after(Symmetric<double> psi, const PolymerMode& mode, const Matrix& L, double time,
                        int steps = 4000) {
  const double dt = time / steps;
  const auto moved = [](const Symmetric<double>& from, const Symmetric<double>& rate, double step) {
    return Symmetric<double>{from.xx + step * rate.xx, from.yy + step * rate.yy, from.xy + step * rate.xy};
  };
  for (int n = 0; n < steps; ++n) {
    const auto middle = moved(psi, Conformation(psi).rate(mode, gradient(L)), 0.5 * dt);
    psi = moved(psi, Conformation(middle).rate(mode, gradient(L)), dt);
  }
  return psi;
}

const Symmetric<double> rest{0, 0, 0};
const Matrix shear{{0, 2}, {0, 0}};  // gdot = 2

TEST(Conformation, IsTheExponentialOfItsLogarithm) {
  for (const Matrix& psi :
       {Matrix{{0.3, -0.7}, {-0.7, 1.9}}, Matrix{{2, 0}, {0, 2}}, Matrix{{0.01, 0.02}, {0.02, -0.01}},
        Matrix{{-3, 2}, {2, 5}}, Matrix{{0.1, 0.03}, {0.03, 0.1}}})
    EXPECT_LT((full(Conformation(symmetric(psi)).value()) - exponential(psi)).norm(),
              1e-13 * exponential(psi).norm())
        << psi;
}

TEST(Conformation, HasTheRateOfItsOwnEquation) {
  // d/dt log A by differences of the equation for A itself
  const Matrix L{{0.7, 1.9}, {-0.4, -0.3}};
  for (const double alpha : {0.0, 0.3})
    for (const Matrix& psi : {Matrix{{0.3, -0.7}, {-0.7, 1.9}}, Matrix{{0.5, 0}, {0, 0.5}},
                              Matrix{{0.2, 0.01}, {0.01, 0.21}}, Matrix{{-0.4, 0.04}, {0.04, -0.4}}}) {
      const PolymerMode mode{0.7, 3, alpha};
      const Matrix A = exponential(psi), I = Matrix::Identity();
      const Matrix rate =
          L * A + A * L.transpose() - ((A - I) + alpha * (A - I) * (A - I)) / mode.relaxation_time;
      const double dt = 1e-5;
      const Matrix expected = (logarithm(A + dt * rate) - logarithm(A - dt * rate)) / (2 * dt);
      const Matrix found = full(Conformation(symmetric(psi)).rate(mode, gradient(L)));
      EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm()) << alpha << '\n' << psi;
    }
}

TEST(Conformation, TurnsWithARotation) {
  const PolymerMode slow{1e12, 1, 0};
  const Matrix psi{{1.2, 0.4}, {0.4, -0.3}}, spin{{0, -1}, {1, 0}};  // anticlockwise, 1 rad/s
  const double angle = 0.8;
  const Eigen::Rotation2Dd R(angle);
  const Matrix turned = R.toRotationMatrix() * psi * R.toRotationMatrix().transpose();
  EXPECT_LT((full(after(symmetric(psi), slow, spin, angle)) - turned).norm(), 1e-6);
}

TEST(OldroydB, GrowsInShearAsItsClosedForm) {
  const PolymerMode mode{0.5, 3, 0};
  for (const double t : {0.1, 0.5, 2.0}) {
    const Symmetric<double> A = Conformation(after(rest, mode, shear, t)).value();
    const double fade = std::exp(-t / 0.5), G = 6;
    EXPECT_NEAR(G * A.xy, 3 * 2 * (1 - fade), 1e-5) << t;
    EXPECT_NEAR(G * (A.xx - A.yy), 2 * 3 * 0.5 * 4 * (1 - fade * (1 + t / 0.5)), 1e-5) << t;
    EXPECT_NEAR(A.yy, 1, 1e-5) << t;
  }
}

TEST(OldroydB, StaysPositiveWhereItsStressHasNoBound) {
  // extension beyond 1/(2 lambda): A_xx grows for ever, A_yy falls to 1/(1 + 2 lambda rate)
  const PolymerMode mode{1, 1, 0};
  const Matrix stretch{{3, 0}, {0, -3}};
  const Symmetric<double> A = Conformation(after(rest, mode, stretch, 4, 400)).value();
  EXPECT_NEAR(std::log(A.xx), 5 * 4 + std::log(1.2), 1e-3);  // 1.2 e^(5 t) - 0.2
  EXPECT_NEAR(A.yy, 1.0 / 7, 1e-4);
}

TEST(Giesekus, ThinsUnderShearAsItsClosedForm) {
  for (const double alpha : {0.1, 0.5})
    for (const double Wi : {0.3, 1.0, 10.0}) {
      const PolymerMode mode{Wi / 2, 3, alpha};
      const Symmetric<double> A =
          Conformation(after(rest, mode, shear, 40 * mode.relaxation_time, 100000)).value();
      // Giesekus 1982; Bird, Armstrong & Hassager 1987, table 7.3-3
      const double a = 8 * alpha * (1 - alpha) * Wi * Wi, chi = std::sqrt((std::sqrt(1 + 2 * a) - 1) / a);
      const double f = (1 - chi) / (1 + (1 - 2 * alpha) * chi);
      const double eta = mode.modulus() * A.xy / 2;
      EXPECT_NEAR(eta / 3, (1 - f) * (1 - f) / (1 + (1 - 2 * alpha) * f), 1e-6) << alpha << ' ' << Wi;
      EXPECT_NEAR(steady_viscosity(mode, 2), eta, 3e-6) << alpha << ' ' << Wi;
      const double N_2 = mode.modulus() * (A.yy - 1), N_1 = mode.modulus() * (A.xx - A.yy);
      EXPECT_NEAR(N_2, -f * mode.modulus(), 1e-6 * mode.modulus());
      EXPECT_NEAR(N_1, 2 * 3 * mode.relaxation_time * 4 * f * (1 - alpha * f) / (Wi * Wi * alpha * (1 - f)),
                  1e-5 * N_1);
    }
}

TEST(Giesekus, HasASteadyViscosityToItsBounds) {
  EXPECT_DOUBLE_EQ(steady_viscosity({0.5, 3, 0}, 7), 3);         // Oldroyd-B
  EXPECT_DOUBLE_EQ(steady_viscosity({0.5, 3, 0.2}, 0), 3);       // at rest
  EXPECT_NEAR(steady_viscosity({0.5, 3, 1}, 4), 3.0 / 5, 1e-4);  // 1/(1 + Wi^2), the limit at alpha = 1
}

TEST(Polymer, HoldsAndLosesWhatTheStressDoes) {
  // power of the stress = rate of the energy + dissipation, where the flow keeps its volume
  const Matrix L{{0.7, 1.9}, {-0.4, -0.7}};
  for (const double alpha : {0.0, 0.3}) {
    const PolymerMode mode{0.7, 3, alpha};
    const Matrix psi{{0.3, -0.7}, {-0.7, 1.1}};
    const Conformation now(symmetric(psi));
    const double dt = 1e-5;
    const Matrix rate = full(now.rate(mode, gradient(L)));
    const double gain = (Conformation(symmetric(psi + dt * rate)).energy(mode) -
                         Conformation(symmetric(psi - dt * rate)).energy(mode)) /
                        (2 * dt);
    const Matrix stress = mode.modulus() * (full(now.value()) - Matrix::Identity());
    EXPECT_NEAR((stress * L).trace(), gain + now.dissipation(mode), 1e-7) << alpha;
    EXPECT_GT(now.dissipation(mode), 0);
  }
  EXPECT_EQ(Conformation(rest).energy({0.7, 3, 0.2}), 0);
  EXPECT_EQ(Conformation(rest).dissipation({0.7, 3, 0.2}), 0);
}

TEST(PolymerStress, PullsAsThePairSumByHandAndBackAsMuch) {
  const double h = 0.13;
  Point i, j;
  i.x = Vec(0.02, 0.01), j.x = Vec(-0.05, 0.08);
  i.rho = 1010, j.rho = 990, i.m = 8, j.m = 11;
  i.polymer_stress = {5, -2, 3};
  j.polymer_stress = {1, 4, -7};
  const auto force = [&](const Point& on, const Point& by) {
    const Rates rates =
        sum_over(on, {by}, CubicSpline(h), [](auto&&... all) { PolymerStressForce{}.momentum(all...); });
    return Vec(on.m * first_lane(rates.a));
  };
  const Matrix sum{{6, -4}, {-4, 2}};
  const Vec by_hand = i.m * j.m / (i.rho * j.rho) * sum * grad_W(i.x, j.x, h);
  EXPECT_LT((force(i, j) - by_hand).norm(), 1e-12 * by_hand.norm());
  EXPECT_LT((force(i, j) + force(j, i)).norm(), 1e-14 * by_hand.norm());
}

TEST(PolymerStress, IsTheSumOfItsModes) {
  const Viscoelasticity medium{{{2, 6, 0}, {0.5, 4, 0.2}}};
  Particles f;
  f.count = 1;
  allocate_polymer(medium, f);
  ASSERT_TRUE(f.log_conformation[2].xx.empty());
  f.log_conformation[0].xx[0] = std::log(3.0);
  f.log_conformation[1].yy[0] = std::log(2.0);
  find_polymer_stress(medium, f, 0);
  EXPECT_NEAR(f.polymer_stress.xx[0], 3 * 2, 1e-13);
  EXPECT_NEAR(f.polymer_stress.yy[0], 8 * 1, 1e-13);
  EXPECT_EQ(f.polymer_stress.xy[0], 0);
}

// --- the solver ---

Setting viscoelastic_column(double mobility = 0.1) {
  Setting setting = collapsing_column();
  setting.parameters.laminar_viscosity = LaminarViscosity{5};
  setting.parameters.viscoelasticity = Viscoelasticity{{{0.1, 20, mobility}, {0.02, 5, 0}}};
  return setting;
}

TEST(ViscoelasticFluid, GivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<Vec>> x;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    WeaklyCompressible solver = viscoelastic_column().solver();
    run_until(solver, 0.02);
    x.push_back(positions(solver));
  }
  omp_set_num_threads(1);
  EXPECT_EQ(x[0], x[1]);
}

TEST(ViscoelasticFluid, TakesTheStepOfItsElasticWavesAndRelaxation) {
  const double h = 0.065, c_0 = 20;
  Setting setting = viscoelastic_column();
  setting.parameters.viscoelasticity = Viscoelasticity{{{0.1, 4e5, 0}, {0.2, 8e5, 0}}};  // G 8 MPa in all
  EXPECT_NEAR(setting.solver().time_step_limit(), 0.25 * h / (c_0 + std::sqrt(8e6 / 1000)), 1e-9);
  setting.parameters.viscoelasticity = Viscoelasticity{{{1e-4, 1e-3, 0}}};
  WeaklyCompressible quick = setting.solver();
  EXPECT_NEAR(quick.time_step_limit(), 0.25 * 1e-4, 1e-9);
  EXPECT_EQ(quick.time_step_rule(), "relaxation");
}

}  // namespace viscoelasticity_test
}  // namespace toryu::fluid
