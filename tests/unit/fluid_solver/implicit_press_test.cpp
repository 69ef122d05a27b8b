// Walls that are pressed in implicit steps: their row by hand, momentum, the pressure of a closed medium,
// ramps, stops, and steps that are long beside all that is stiff.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include "fluid_solver/implicit/implicit.hpp"
#include "fluid_solver/implicit/pistons.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

using Vector = Eigen::VectorXd;

constexpr double length_of_step = 0.1;

/// A piston 0.5 m wide that presses downwards, between stops 0.1 m back and 0.2 m on.
struct Pressed {
  Pressed() : boundaries(1) {
    PressedMotion motion{.press = {.pressure = {{0, 10}, {2, 30}},
                                   .force = {},
                                   .direction = Direction::minus_y,
                                   .travel = Vec(-0.1, 0.2)},
                         .start = {Vec(1, 2)},
                         .area = 0.5,
                         .mass = 4,
                         .time = 0.9,
                         .way = 0.1,
                         .speed = 0.4,
                         .acceleration = 2};
    motion.begin_step(0.95, 1.0);
    boundaries[0].motion = motion;
    boundaries[0].place({Vec(1, 2)}, {0.01}, 1000, 0.1);
    boundaries[0].force_on_fluid.by_cluster = {Vec(3, -1), Vec(0, -2)};
    parameters.spacing = 0.05;
    parameters.enclosed_medium.emplace();
  }
  PressedMotion& motion() { return std::get<PressedMotion>(boundaries[0].motion); }
  Pistons pistons(double p_b = 15) {
    return {boundaries, parameters, EquationOfState{1000, 20, 7, p_b}, length_of_step};
  }
  std::vector<Boundary> boundaries;
  Parameters parameters;
};

Vector one(double value) {
  return Vector::Constant(1, value);
}

TEST(Pistons, HaveTheRowOfTheirForcesByHand) {
  Pressed pressed;
  EXPECT_DOUBLE_EQ(pressed.motion().way, 0.12);
  const Pistons pistons = pressed.pistons();
  EXPECT_DOUBLE_EQ(pistons.speeds()[0], 0.4);
  EXPECT_DOUBLE_EQ(pistons.accelerations()[0], 2);
  // The press has 20 Pa at the end of the step, q = 20 - 15, the medium pushes back by 3 N: 4.5 N. Of 0.7
  // m/s, over the 25 kg before the face: (4 (0.4 - 0.7) + 0.1 * 4.5)/25
  EXPECT_NEAR(pistons.unbalance(one(0.7))[0], (4 * (0.4 - 0.7) + 0.1 * 4.5) / 25, 1e-15);
}

TEST(Pistons, DriveWithTheirForceAndNotWithTheirMomentum) {
  for (const double mass : {0.0, 4.0, 1e6}) {
    Pressed pressed;
    pressed.motion().mass = mass;
    EXPECT_NEAR(pressed.pistons().driving()[0], 0.1 * 4.5 / 25, 1e-15) << mass;
  }
  Pressed pressed;
  Pistons pistons = pressed.pistons();
  Vector u = one(9);
  pistons.release(u);
  pressed.boundaries[0].force_on_fluid.by_cluster = {Vec(0, 100)};
  pistons.hold_at_stops(u);
  EXPECT_DOUBLE_EQ(pistons.driving()[0], 1.6) << "held by a stop";
}

TEST(Pistons, MoveTheirParticlesAlongTheirAxis) {
  Pressed pressed;
  pressed.pistons().move_at(one(0.7));
  EXPECT_TRUE(at(pressed.boundaries[0].v, 0).isApprox(Vec(0, -0.7)));
  EXPECT_TRUE(at(pressed.boundaries[0].acceleration, 0).isApprox(Vec(0, -3)));
}

TEST(Pistons, AreHeldWhereTheyArePushedOnAtAStopAlone) {
  Pressed pressed;
  Pistons pistons = pressed.pistons();
  Vector u = one(9);
  pistons.release(u);
  EXPECT_DOUBLE_EQ(u[0], 0.08 / 0.05) << "as far as the stop in the half of the step that is left";
  pistons.hold_at_stops(u);  // its inertia pulls back by 4 (1.6 - 0.4) N.s, more than the press pushes
  EXPECT_TRUE(pistons.free_number_of(pressed.boundaries[0]));
  pressed.boundaries[0].force_on_fluid.by_cluster = {Vec(0, 100)};  // the medium pulls
  pistons.hold_at_stops(u);
  EXPECT_FALSE(pistons.free_number_of(pressed.boundaries[0]));
  EXPECT_NEAR(pistons.unbalance(one(1.7))[0], 1.6 - 1.7, 1e-14);
  Vector beside = one(1.59);
  pistons.release(beside);
  EXPECT_DOUBLE_EQ(beside[0], 1.6) << "what the linear solver leaves";
  EXPECT_TRUE(pistons.free_number_of(pressed.boundaries[0]));
  u = one(-9);
  pistons.release(u);
  EXPECT_DOUBLE_EQ(u[0], -0.22 / 0.05);
}

TEST(Pistons, LeaveTheStepWhereTheyAre) {
  Pressed pressed;
  Pistons pistons = pressed.pistons();
  pistons.finish(one(0.6));
  EXPECT_DOUBLE_EQ(pressed.motion().way_at(1.0), 0.12 + 0.05 * 0.6);
  EXPECT_DOUBLE_EQ(pressed.motion().way_at(1.05), 0.12 + 0.1 * 0.6);
  EXPECT_DOUBLE_EQ(pressed.motion().acceleration, 2);
  EXPECT_DOUBLE_EQ(pressed.motion().mean_speed, 0.6) << "at which the forces were found";
  Pressed at_stop;
  Pistons last = at_stop.pistons();
  Vector u = one(9);
  last.release(u);
  last.finish(u);
  EXPECT_EQ(at_stop.motion().way_at(1.0), 0.2) << "and not a rounding beside it";
  EXPECT_EQ(at_stop.motion().speed_at(1.0), 0);
}

void set_masses(Setting& s, double mass) {
  for (auto& wall : s.scene.walls)
    if (wall.press) wall.press->mass = mass;
}

/// A medium without weight between two pistons without inertia, 1 m by 0.5 m, whose walls hold no shear.
Setting between_pistons(const Press& left, const Press& right) {
  Setting s = space_of_implicit_steps();
  s.parameters.kernel = KernelForm::wendland_c2;
  s.parameters.smoothing_ratio = 2;
  s.parameters.wall_model.slip = WallSlip::free_slip;
  s.parameters.implicit = ImplicitSolver{.expected_speed = 0.1};
  s.parameters.enclosed_medium.emplace();
  s.parameters.background_pressure = BackgroundPressure{5e3};
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.5)}, Vec::Zero()}};
  s.scene.walls = {{"lower", {Vec(-0.5, -0.2), Vec(1.5, 0)}, {}},
                   {"upper", {Vec(-0.5, 0.5), Vec(1.5, 0.7)}, {}},
                   {"left", {Vec(-0.2, 0), Vec(0, 0.5)}, {}, left},
                   {"right", {Vec(1, 0), Vec(1.2, 0.5)}, {}, right}};
  set_masses(s, 1e-9);
  return s;
}
Press press(double before, double after, Direction direction, const Vec& travel = Vec(-0.2, 0.2)) {
  return {.pressure = {{0, before}, {0.5, after}}, .force = {}, .direction = direction, .travel = travel};
}

const Boundary& find(const FluidModel& model, const std::string& name) {
  for (const auto& boundary : model.boundaries())
    if (boundary.name == name) return boundary;
  throw std::out_of_range(name);
}
const PressedMotion& motion_of(const FluidModel& model, const std::string& name) {
  return std::get<PressedMotion>(find(model, name).motion);
}
double mean_pressure(const FluidModel& model) {
  const Particles& f = model.particles();
  double volume = 0, sum = 0;
  for (std::size_t i = 0; i < f.count; ++i) volume += f.V[i], sum += f.V[i] * f.p[i];
  return sum / volume + model.pressure_offset();
}

// Both presses have 40 kPa at last, of which the medium knows nothing. On the way it is compressed by
// nothing.
TEST(ImplicitPress, HoldsAClosedMediumAtItsPressureWhileItRises) {
  const Setting s = between_pistons(press(1e4, 4e4, Direction::plus_x), press(1e4, 4e4, Direction::minus_x));
  Implicit model(s.parameters, s.scene);
  for (int n = 1; n <= 12; ++n) {
    model.advance(0.05);
    const double wanted = 1e4 + std::min(0.05 * n, 0.5) / 0.5 * 3e4;
    EXPECT_NEAR(mean_pressure(model), wanted, 0.01 * wanted) << n;
  }
}

// Without [fluid.enclosed_medium] the medium is compressed: by K = 400 kPa, 4 kPa more take 1 %, half by
// either.
TEST(ImplicitPress, CompressesTheMediumAsItsPressureRises) {
  Setting s = between_pistons(press(5e3, 9e3, Direction::plus_x), press(5e3, 9e3, Direction::minus_x));
  s.parameters.enclosed_medium.reset();
  s.parameters.implicit->tolerance = 1e-8;
  Implicit model(s.parameters, s.scene);
  double before = 0;
  for (int n = 1; n <= 12; ++n) {
    model.advance(0.05);
    const double wanted = 5e3 + std::min(0.05 * n, 0.5) / 0.5 * 4e3, way = motion_of(model, "left").way;
    if (n > 1) {  // the first step meets a medium at rest
      EXPECT_NEAR(mean_pressure(model), wanted, 0.01 * wanted) << n;
    }
    EXPECT_GE(way, before - 1e-9) << "no swing";
    before = way;
  }
  EXPECT_GT(before, 0.5 * 4e3 / 4e5);  // a row more gives way by the wall's
}

TEST(ImplicitPress, CountsWhatPistonsGiveTheMedium) {
  Setting s = between_pistons(press(1e4, 4e4, Direction::plus_x), press(1e4, 1e4, Direction::minus_x));
  s.parameters.implicit->tolerance = 1e-10;
  set_masses(s, 300);
  Implicit model(s.parameters, s.scene);
  for (int n = 0; n < 6; ++n) model.advance(0.02);
  double given = 0, scale = 0;
  for (const auto& boundary : model.boundaries())
    given += boundary.impulse.total[0], scale += boundary.impulse.total.norm();
  EXPECT_GT(model.momentum()[0], 1e-3 * scale);
  EXPECT_NEAR(model.momentum()[0], given, 1e-8 * scale);
}

TEST(ImplicitPress, StopsAtTheStopAndComesBack) {
  Setting s = between_pistons(press(2e4, 2e4, Direction::plus_x, Vec(-0.1, 0.031)),
                              press(1e4, 1e4, Direction::minus_x));
  s.scene.walls[2].press->pressure = {{0, 2e4}, {0.2, 2e4}, {0.25, 0}};
  Implicit model(s.parameters, s.scene);
  double furthest = 0, last_speed = 0;
  bool stood = false;
  for (int n = 0; n < 60; ++n) {
    model.advance(0.01);
    const auto& left = motion_of(model, "left");
    furthest = std::max(furthest, left.way);
    last_speed = left.speed_at(model.time());
    stood = stood || (left.way == 0.031 && last_speed == 0);
  }
  EXPECT_EQ(furthest, 0.031);
  EXPECT_TRUE(stood);
  EXPECT_LT(motion_of(model, "left").way, 0.03) << "the other presses it back";
}

// In steady flow a heavy piston asks the same of the medium as one without mass: to the same accuracy, with
// as many products.
TEST(ImplicitPress, KeepsTheToleranceOfTheMediumHoweverHeavyThePiston) {
  Setting s = between_pistons(press(2e4, 2e4, Direction::plus_x), press(1e4, 1e4, Direction::minus_x));
  s.parameters.wall_model.slip = WallSlip::no_slip;
  std::stringstream steady;
  {
    Implicit model(s.parameters, s.scene);
    for (int n = 0; n < 10; ++n) model.advance(0.01);
    model.write_state(steady);
  }
  struct Flow {
    double products, u;
    std::vector<double> v;
  };
  const auto run = [&](double mass, double tolerance) {
    Setting here = s;
    set_masses(here, mass);
    here.parameters.implicit->tolerance = tolerance;
    Implicit model(here.parameters, here.scene);
    std::stringstream from(steady.str());
    model.read_state(from);
    for (int n = 0; n < 10; ++n) model.advance(0.01);
    const Particles& f = model.particles();
    Flow flow{model.figures()[0].second, motion_of(model, "left").speed, std::vector<double>(f.count)};
    for (std::size_t i = 0; i < f.count; ++i) flow.v[f.id[i]] = f.v[0][i];
    return flow;
  };
  const auto error = [](const Flow& flow, const Flow& exact) {
    double sum = 0;
    for (std::size_t i = 0; i < flow.v.size(); ++i) sum += std::pow(flow.v[i] - exact.v[i], 2);
    return std::sqrt(sum / static_cast<double>(flow.v.size())) / std::abs(exact.u);
  };
  const Flow light = run(1e-9, 1e-3), heavy = run(1e6, 1e-3);
  const double of_light = error(light, run(1e-9, 1e-8)), of_heavy = error(heavy, run(1e6, 1e-8));
  RecordProperty("products", fmt::format("{} {}", light.products, heavy.products));
  RecordProperty("errors", fmt::format("{} {}", of_light, of_heavy));
  EXPECT_GT(light.u, 1e-3);
  EXPECT_GE(heavy.products, 0.5 * light.products);
  EXPECT_LE(of_heavy, 2 * of_light);
}

// What the press gives is what the medium takes up but for the heat; what is left falls with the step.
TEST(ImplicitPress, BalancesItsWorkAsStepsBecomeShorter) {
  const auto remainder = [](double step) {
    Setting s = between_pistons(press(5e3, 9e3, Direction::plus_x), press(5e3, 7e3, Direction::minus_x));
    s.parameters.wall_model.slip = WallSlip::no_slip;
    s.parameters.implicit->tolerance = 1e-8;
    Implicit model(s.parameters, s.scene);
    while (model.time() < 0.4 - 1e-9) {
      model.advance(step);
      model.record(model.time());
    }
    const auto row = columns(model);
    EXPECT_GT(row.at("work_from_left") + row.at("work_from_right"), 0);
    return row.at("energy_remainder") / row.at("dissipated_energy");
  };
  const double coarse = remainder(0.02), middle = remainder(0.01), fine = remainder(0.005);
  testing::Test::RecordProperty("remainders", fmt::format("{} {} {}", coarse, middle, fine));
  EXPECT_LT(std::abs(fine), 0.06);
  EXPECT_LT(std::abs(middle), 0.5 * std::abs(coarse));
  EXPECT_LT(std::abs(fine), 0.5 * std::abs(middle));
}

TEST(ImplicitPress, IsTheSameBitByBitForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    omp_set_num_threads(threads);
    Setting s = between_pistons(press(1e4, 4e4, Direction::plus_x), press(1e4, 1e4, Direction::minus_x));
    s.parameters.wall_model.slip = WallSlip::no_slip;
    Implicit model(s.parameters, s.scene);
    for (int n = 0; n < 2; ++n) model.advance(0.02);
    omp_set_num_threads(1);
    std::vector<double> all{motion_of(model, "left").speed, motion_of(model, "right").speed};
    for (std::size_t i = 0; i < model.particles().count; ++i) all.push_back(model.particles().x[0][i]);
    return all;
  };
  const auto one_thread = run(1);
  EXPECT_GT(one_thread[0], 1e-3);
  EXPECT_EQ(run(2), one_thread);
  EXPECT_EQ(run(3), one_thread);
}

}  // namespace
}  // namespace toryu::fluid
