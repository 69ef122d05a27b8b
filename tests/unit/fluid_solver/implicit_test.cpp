// The implicit model: its matrix pair by pair and against the explicit sweeps, momentum, decay, stability,
// and how a step that is not solved ends.
#include "fluid_solver/implicit/implicit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "common/error/failure.hpp"
#include "common/sph/skin.hpp"
#include "tests/one_thread.hpp"
#include "tests/said.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

using testing::HasSubstr;
using Vector = StepSystem::Vector;

constexpr double h = 0.013, c_0 = 20, mu = 3, dt = 0.7e-3;

const std::vector<Point> three{{{0.100, 0.200}, {0.3, -0.2}, 1010, 0.11},
                               {{0.109, 0.203}, {-0.1, 0.1}, 1005, 0.10},
                               {{0.095, 0.214}, {0.2, 0.5}, 990, 0.12}};

/// Particles in empty space as a step meets them.
struct Few {
  explicit Few(const std::vector<Point>& points) {
    fluid.count = points.size();
    fluid.id.resize(fluid.count);
    std::iota(fluid.id.begin(), fluid.id.end(), 0u);
    resize_fields(fluid, padded(fluid.count));
    for (std::size_t i = 0; i < points.size(); ++i) {
      set(fluid.x, i, points[i].x);
      set(fluid.v, i, points[i].v);
      fluid.rho[i] = points[i].rho;
      fluid.m[i] = points[i].m;
    }
    lists.build(fluid, none, 0);
  }
  Particles fluid;
  std::vector<Boundary> none;
  Neighbours lists{2 * h, 0.1 * h, 0.1, {Vec::Zero()}};
};

ImplicitTerms terms_of(const Parameters& p) {
  return {p, Vec::Zero(), CubicSpline(h), EquationOfState{1000, c_0, 7, 5000}};
}

Parameters newtonian() {
  Parameters p;
  p.laminar_viscosity = LaminarViscosity{mu};
  return p;
}

/// Column by column: what unit velocities change.
Eigen::MatrixXd matrix_of(StepSystem& system) {
  const auto n = 2 * static_cast<Eigen::Index>(system.diagonal().size());
  const Vector at_rest = system.unbalance(Vector::Zero(n), Viscosity::kept);
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    A.col(k) = at_rest - system.unbalance(Vector::Unit(n, k), Viscosity::kept);
  return A;
}

TEST(ImplicitMatrix, HasTheEntriesOfViscosityAndCompressionByHand) {
  Few few(three);
  const Particles& f = few.fluid;
  const ImplicitTerms terms = terms_of(newtonian());
  StepSystem system(terms, few.fluid, few.lists.of_fluid(), few.none, dt);
  const Eigen::MatrixXd A = matrix_of(system);
  const auto grad = [&](std::size_t i, std::size_t j) -> Vec {
    return i == j ? Vec(Vec::Zero()) : grad_W(at(f.x, i), at(f.x, j), h);
  };
  for (std::size_t j = 0; j < 3; ++j)  // who moves
    for (int b = 0; b < dim; ++b) {    // and in which direction
      const auto v = [&](std::size_t i) -> Vec { return i == j ? Vec(Vec::Unit(b)) : Vec(Vec::Zero()); };
      std::array<double, 3> change{};  // of the pressure, K dt D v
      for (std::size_t i = 0; i < 3; ++i) {
        const double c2 = c_0 * c_0 * std::pow(f.rho[i] / 1000, 6);
        for (std::size_t k = 0; k < 3; ++k)
          change[i] += c2 * dt * f.rho[i] * f.m[k] / f.rho[k] * (v(i) - v(k)).dot(grad(i, k));
      }
      for (std::size_t i = 0; i < 3; ++i) {
        Vec a = Vec::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
          if (k == i) continue;
          const Vec x_ik = at(f.x, i) - at(f.x, k);
          a -= f.m[k] * (change[i] / (f.rho[i] * f.rho[i]) + change[k] / (f.rho[k] * f.rho[k])) * grad(i, k);
          a += f.m[k] * 2 * mu / (f.rho[i] * f.rho[k]) * x_ik.dot(grad(i, k)) / x_ik.squaredNorm() *
               (v(i) - v(k));
        }
        const Vec expected = v(i) - dt * a;
        for (int k = 0; k < dim; ++k)
          EXPECT_NEAR(A(3 * k + static_cast<Eigen::Index>(i), 3 * b + static_cast<Eigen::Index>(j)),
                      expected[k], 1e-12 * A.norm())
              << i << k << j << b;
      }
    }
  EXPECT_GT((A - Eigen::MatrixXd::Identity(6, 6)).norm(), 0.1);
}

TEST(ImplicitMatrix, HasTheDiagonalBlocksOfThePreconditioner) {
  Few few(three);
  const ImplicitTerms terms = terms_of(newtonian());
  StepSystem system(terms, few.fluid, few.lists.of_fluid(), few.none, dt);
  const Eigen::MatrixXd A = matrix_of(system);
  const auto blocks = system.diagonal();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        EXPECT_NEAR(blocks[static_cast<std::size_t>(i)](a, b), A(3 * a + i, 3 * b + i), 1e-12 * A.norm());
}

TEST(ImplicitMatrix, GivesAndTakesMomentumPairByPair) {
  for (const bool varies : {false, true}) {
    Parameters p = newtonian();
    if (varies) {
      p.laminar_viscosity.reset();
      p.carreau = Carreau{5, 0.1, 0.1, 0.5};
    }
    Few few(three);
    few.fluid.gdot.resize(padded(3));
    few.fluid.eta.resize(padded(3));
    resize(few.fluid.eta_grad_v, padded(3));
    const ImplicitTerms terms = terms_of(p);
    resize(few.fluid.a_before, padded(3));
    StepSystem system(terms, few.fluid, few.lists.of_fluid(), few.none, dt);
    system.unbalance(system.foreseen_velocities(), Viscosity::renewed);
    const Eigen::MatrixXd A = matrix_of(system);
    for (Eigen::Index column = 0; column < 6; ++column)
      for (int a = 0; a < dim; ++a) {
        double momentum = 0;
        for (Eigen::Index i = 0; i < 3; ++i)
          momentum += few.fluid.m[static_cast<std::size_t>(i)] * A(3 * a + i, column);
        const bool own = column / 3 == a;
        EXPECT_NEAR(momentum, own ? few.fluid.m[static_cast<std::size_t>(column % 3)] : 0.0,
                    1e-14 * A.norm());
      }
  }
}

/// A medium between plates, stirred: walls extrapolate.
Setting stirred_slit() {
  Setting s = space_of_implicit_steps();
  s.parameters.start_disorder = 0.1;
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.6)}, Vec(0.3, 0.1)}};
  s.scene.walls = {{"lower", {Vec(-0.2, -0.2), Vec(1.2, 0)}, {}},
                   {"upper", {Vec(-0.2, 0.6), Vec(1.2, 0.8)}, {}},
                   {"left", {Vec(-0.2, 0), Vec(0, 0.6)}, Motion{{{0.0, 0.0, 0.0}, {0.05, 0.3, 0.0}}}},
                   {"right", {Vec(1, 0), Vec(1.2, 0.6)}, Motion{{{0.0, 0.0, 0.0}, {0.05, 0.3, 0.0}}}}};
  s.scene.gravity = Vec(0.5, -1);
  return s;
}

void thin_under_shear(Setting& s) {
  s.parameters.laminar_viscosity.reset();
  s.parameters.power_law = PowerLaw{1000, 0.4, 10, 16000};
}

// With a step of no length the pressure is that of the state: the rates are those of the explicit model.
TEST(ImplicitMatrix, HasTheRatesOfTheExplicitSweepsAtWallsToo) {
  for (const auto& [varies, slides] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}})
    for (const auto extrapolation : {WallExtrapolation::mean, WallExtrapolation::fit}) {
      Setting s = stirred_slit();
      s.parameters.wall_model.extrapolation = extrapolation;
      if (varies) thin_under_shear(s);
      if (slides) s.parameters.wall_slip = SlipLaw{.coefficient = 1e-7, .exponent = 1.5};
      Implicit model(s.parameters, s.scene);
      model.advance(1e-3);  // a flow that nobody chose
      Particles fluid = model.particles();
      std::vector<Boundary> boundaries = model.boundaries();
      Neighbours lists(2 * s.parameters.h(), 0.01, s.parameters.strip_width(), {Vec::Zero()});
      lists.build(fluid, boundaries, 0);
      const CubicSpline W(s.parameters.h());
      const EquationOfState state{s.parameters.density, s.parameters.sound_speed, 7, 0};
      const ImplicitTerms terms(s.parameters, s.scene.gravity, W, state);
      StepSystem system(terms, fluid, lists.of_fluid(), boundaries, 0);
      system.unbalance(system.foreseen_velocities(), Viscosity::renewed);
      const Particles found = fluid;
      const Dynamics dynamics(s.parameters, s.scene.gravity, W, state);
      Timers timers;
      dynamics.evaluate(RatesOf::both, fluid, lists.of_fluid(), boundaries, timers);
      EXPECT_GT(largest_norm(fluid.a, fluid.count), 1);
      double fastest = 0;  // of the densities: a sum of them may be near 0
      for (std::size_t i = 0; i < fluid.count; ++i) fastest = std::max(fastest, std::abs(fluid.drho[i]));
      for (std::size_t i = 0; i < fluid.count; ++i) {
        EXPECT_LT((at(found.a, i) - at(fluid.a, i)).norm(), 1e-12 * largest_norm(fluid.a, fluid.count));
        EXPECT_NEAR(found.drho[i], fluid.drho[i], 1e-12 * fastest);
      }
    }
}

/// Of the particles of the wall that has the largest.
double largest_slip(const Implicit& model) {
  double largest = 0;
  for (const Boundary& wall : model.boundaries())
    largest = std::max(largest, largest_norm(wall.slip_velocity, wall.count));
  return largest;
}

TEST(Implicit, StartsToSlideFromRest) {
  Setting s = stirred_slit();
  thin_under_shear(s);
  s.parameters.wall_slip = SlipLaw{.coefficient = 1e-7, .exponent = 1.5};
  Implicit model(s.parameters, s.scene);
  for (int n = 0; n < 10; ++n) model.advance(2e-3);
  EXPECT_GT(largest_slip(model), 0.01 * largest_norm(model.particles().v, model.particles().count));
  Setting at_rest = s;
  for (auto& wall : at_rest.scene.walls) wall.motion.reset();
  Implicit falling(at_rest.parameters, at_rest.scene);  // nothing moves but what gravity pulls
  falling.advance(2e-3);
  EXPECT_TRUE(std::isfinite(largest_slip(falling)));
}

TEST(Implicit, IsSolvedWhereRoundingAloneDrivesTheMedium) {
  Setting s = stirred_slit();
  s.parameters.start_disorder = 0;
  s.parameters.regions[0].velocity = Vec::Zero();
  s.parameters.background_pressure = BackgroundPressure{1e5};
  s.scene.gravity = Vec::Zero();
  for (auto& wall : s.scene.walls) wall.motion.reset();
  Implicit model(s.parameters, s.scene);
  for (int n = 0; n < 3; ++n) model.advance(2e-3);
  EXPECT_LT(largest_norm(model.particles().v, model.particles().count), 1e-9);
}

TEST(Implicit, TellsOfAStepThatNothingForetold) {
  const Setting s = stirred_slit();
  const Said said;
  Implicit model(s.parameters, s.scene);
  model.advance(2e-3);
  EXPECT_EQ(said.times("spacings in the step"), 0) << said.text();
  model.advance(0.4);
  EXPECT_EQ(said.times("give 'expected_speed' in [fluid.implicit]"), 1) << said.text();
}

TEST(Implicit, KeepsMomentumInEmptySpace) {
  Setting s = colliding_drops();
  s.parameters.model = Model::implicit;
  s.parameters.artificial_viscosity.reset();
  s.parameters.density_diffusion.reset();
  s.parameters.laminar_viscosity = LaminarViscosity{500};
  s.parameters.implicit = ImplicitSolver{.tolerance = 1e-10};
  Implicit model(s.parameters, s.scene);
  const Vec before = model.momentum();
  const double energy = model.kinetic_energy();
  for (int n = 0; n < 5; ++n) model.advance(2e-3);
  EXPECT_LT(model.kinetic_energy(), 0.9 * energy);
  EXPECT_LT((model.momentum() - before).norm(), 1e-9 * before.norm());
}

TEST(Implicit, CountsTheImpulseOfWallsToTheToleranceOfTheSolver) {
  Setting s = stirred_slit();
  s.parameters.implicit = ImplicitSolver{.tolerance = 1e-9};
  Implicit model(s.parameters, s.scene);
  const Vec before = model.momentum();
  double mass = 0, scale = 0;
  for (std::size_t i = 0; i < model.particles().count; ++i) mass += model.particles().m[i];
  for (int n = 0; n < 10; ++n) model.advance(4e-3);
  Vec given = 10 * 4e-3 * mass * s.scene.gravity;
  for (const auto& wall : model.boundaries()) given += wall.impulse.total, scale += wall.impulse.total.norm();
  EXPECT_LT((model.momentum() - before - given).norm(), 1e-8 * scale);
}

// A field that advances (FieldKind::state) is sorted with the others, and is in checkpoints.
TEST(Implicit, ForeseesVelocitiesByTheAccelerationOfTheLastStep) {
  Few few(three);
  resize(few.fluid.a_before, padded(3));
  const ImplicitTerms terms = terms_of(newtonian());
  Vector v(6);
  v << 1, 2, 3, 4, 5, 6;
  const Vec first = at(few.fluid.v, 0), last = at(few.fluid.v, 2);
  StepSystem(terms, few.fluid, few.lists.of_fluid(), few.none, dt).finish(v);
  EXPECT_EQ(few.fluid.a_before.kind, FieldKind::state);
  StepSystem next(terms, few.fluid, few.lists.of_fluid(), few.none, 0.5 * dt);
  EXPECT_NEAR(next.foreseen_velocities()[0], 1 + 0.5 * (1 - first[0]), 1e-12);
  EXPECT_NEAR(next.foreseen_velocities()[5], 6 + 0.5 * (6 - last[1]), 1e-12);
}

TEST(Implicit, TakesFewIterationsWhereTheFlowIsSteady) {
  Setting s = stirred_slit();
  thin_under_shear(s);
  Implicit model(s.parameters, s.scene);
  for (int n = 0; n < 30; ++n) model.advance(2e-3);
  RecordProperty("iterations", std::to_string(model.figures()[0].second));
  RecordProperty("updates", std::to_string(model.figures()[1].second));
  EXPECT_LT(model.figures()[0].second, 7);
  EXPECT_LT(model.figures()[1].second, 2.8);
}

/// Slow vortices in a periodic square, and the rate at which they decay.
constexpr double k = 2 * M_PI, nu = 1.0, rate = 2 * nu * k * k;
Setting vortices() {
  Setting s = empty_space();
  s.scene.domain = {Vec(0, 0), Vec(1, 1)};
  s.scene.periodic = Periodic::xy;
  s.parameters.model = Model::implicit;
  s.parameters.artificial_viscosity.reset();
  s.parameters.density_diffusion.reset();
  s.parameters.kernel = KernelForm::wendland_c2;
  s.parameters.smoothing_ratio = 2;
  s.parameters.spacing = 0.025;
  s.parameters.laminar_viscosity = LaminarViscosity{1000 * nu};
  s.parameters.regions = {{"all", s.scene.domain, Vec::Zero()}};
  s.parameters.initial_flow = InitialFlow{FlowProfile::taylor_green, 1e-4, 1.0, 0, Vec::Zero()};
  s.parameters.implicit = ImplicitSolver{.tolerance = 1e-9};
  return s;
}
/// Speed of the fastest over that at the start after `steps` steps of dt.
double left_of_vortices(double step, int steps) {
  const Setting s = vortices();
  Implicit model(s.parameters, s.scene);
  const double before = largest_norm(model.particles().v, model.particles().count);
  for (int n = 0; n < steps; ++n) model.advance(step);
  return largest_norm(model.particles().v, model.particles().count) / before;
}

TEST(ImplicitRun, DecaysVorticesAsTheExactSolutionToFirstOrder) {
  const double T = 1 / rate;
  const double coarse = left_of_vortices(T / 8, 8), middle = left_of_vortices(T / 16, 16),
               fine = left_of_vortices(T / 32, 32);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 1, 0.06);
  EXPECT_NEAR(2 * fine - middle, std::exp(-1), 0.01);  // what remains is of the spacing
}

TEST(Implicit, IsStableAtAHundredTimesTheExplicitViscousStep) {
  const double h_of_vortices = 2 * 0.025, step = 100 * 0.125 * h_of_vortices * h_of_vortices / nu;
  EXPECT_NEAR(left_of_vortices(step, 1), 1 / (1 + rate * step), 0.03 / (1 + rate * step));
  EXPECT_LT(left_of_vortices(step, 6), 1.1 * std::pow(1 + rate * step, -6));
}

TEST(Implicit, IsTheSameBitByBitForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    omp_set_num_threads(threads);
    Setting s = stirred_slit();
    thin_under_shear(s);
    s.parameters.particle_shifting = ParticleShifting{};
    Implicit model(s.parameters, s.scene);
    for (int n = 0; n < 3; ++n) model.advance(2e-3);
    omp_set_num_threads(1);
    std::vector<Vec> x;
    for (std::size_t i = 0; i < model.particles().count; ++i) x.push_back(at(model.particles().x, i));
    return x;
  };
  const auto one = run(1);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(3), one);
}

TEST(Implicit, LimitsTheStepByWhatMovesOrPulls) {
  Setting s = stirred_slit();
  const double speed = Vec(0.3, 0.1).norm();
  EXPECT_DOUBLE_EQ(Implicit(s.parameters, s.scene).time_step_limit(), 0.2 * 0.05 / speed);
  s.scene.walls[2].motion->speed = 4;  // the fastest of its table
  EXPECT_DOUBLE_EQ(Implicit(s.parameters, s.scene).time_step_limit(), 0.2 * 0.05 / 1.2);
  s.parameters.implicit = ImplicitSolver{.expected_speed = 6};
  EXPECT_DOUBLE_EQ(Implicit(s.parameters, s.scene).time_step_limit(), 0.2 * 0.05 / 6);
  s.parameters.implicit.reset();
  s.scene.gravity = Vec(0, -1000);
  s.parameters.time_step_share = 0.5;
  EXPECT_DOUBLE_EQ(Implicit(s.parameters, s.scene).time_step_limit(), std::sqrt(0.1 * 0.05 / 1000));
}

std::string failure_of(Setting s, const ImplicitSolver& solver) {
  s.parameters.implicit = solver;
  Implicit model(s.parameters, s.scene);
  try {
    model.advance(2e-3);
  } catch (const PhysicsFailure& failure) {
    return failure.what();
  }
  return "";
}

TEST(Implicit, SaysThatAStepIsNotSolved) {
  Setting s = stirred_slit();
  EXPECT_EQ(failure_of(s, {}), "");
  EXPECT_THAT(failure_of(s, {.largest_iterations = 3}),
              HasSubstr("the implicit step is not solved: unbalanced force over the driving one after 3 "
                        "iterations of the linear solver (fluid.implicit.largest_iterations: 3) = "));
  thin_under_shear(s);
  EXPECT_THAT(failure_of(s, {.largest_viscosity_updates = 1}),
              HasSubstr("after 1 update of the viscosity (fluid.implicit.largest_viscosity_updates) = "));
}

}  // namespace
}  // namespace toryu::fluid
