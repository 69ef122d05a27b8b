/// A rigid body against motions that are known in closed form, and against forces worked by hand.
#include "solid_solver/rigid/rigid_body.hpp"

#include <cmath>
#include <numbers>

#include "common/scene/outline.hpp"
#include "samples.hpp"

namespace toryu::solid::of_rigid_bodies {
namespace {

/// A bar of 0.08 x 0.02 m with its lower left corner at the origin, of 1000 kg/m3: 1.6 kg/m.
Parameters bar() {
  Parameters p;
  p.formulation = Formulation::rigid;
  p.material = {1000, 0, 0};
  p.spacing = 0.005;
  p.regions = {{"bar", {Vec(0, 0), Vec(0.08, 0.02)}}};
  return p;
}
constexpr double m = 1.6, I = m * (0.08 * 0.08 + 0.02 * 0.02) / 12;

RigidBody rigid(const Parameters& p, const Scene& scene = empty_scene()) {
  return {p, body_of(p), scene};
}

Parameters mounted(const Mounting& mounting) {
  Parameters p = bar();
  p.mounting = mounting;
  return p;
}

/// The same of few particles, where their number does not matter.
Parameters coarse(Parameters p) {
  p.spacing = 0.02;
  return p;
}

/// Advances by `count` equal steps to `time` [s].
void step_to(SolidModel& model, double time, int count) {
  for (int n = 0; n < count; ++n) model.advance(time / count);
}

/// The load of a fluid on `particles`: forces alone.
InterfaceLoad load_of(const std::vector<Vec>& forces) {
  InterfaceLoad load;
  for (const Vec& force : forces) {
    load.pressure.push_back(0);
    load.force.insert(load.force.end(), force.begin(), force.end());
  }
  return load;
}

TEST(RigidBody, HasTheMomentsOfARectangleWhateverItsParticles) {
  for (const double spacing : {0.02, 0.01, 0.005}) {
    Parameters p = bar();
    p.spacing = spacing;
    const RigidBody body = rigid(p);
    EXPECT_NEAR(body.inertia()[0], m, 1e-14);
    EXPECT_NEAR(body.inertia()[2] / I, 1, 1e-13);
  }
}

TEST(RigidBody, HasTheMomentsOfADiscThatParticlesFit) {
  Parameters p = bar();
  p.spacing = 0.005;
  p.regions = {{"disc", box_of(Outline({ellipse_ring({0.1, 0.2}, {0.05, 0.05})}))}};
  const RigidBody body = rigid(p);
  const double mass = 1000 * std::numbers::pi * 0.05 * 0.05;
  EXPECT_NEAR(body.inertia()[0] / mass, 1, 1e-3);
  EXPECT_NEAR(body.inertia()[2] / (0.5 * mass * 0.05 * 0.05), 1, 3e-3);
}

TEST(RigidBody, FallsExactly) {
  Scene scene = empty_scene();
  scene.gravity = Vec(1, -10);
  Parameters p = bar();
  p.initial_velocity = InitialVelocity{.velocity = Vec(0, 2)};
  RigidBody body = rigid(p, scene);
  step_to(body, 0.3, 3);
  EXPECT_NEAR((body.coordinates() - Coordinates(0.045, 0.6 - 0.45, 0)).norm(), 0, 1e-13);
  EXPECT_NEAR((body.velocities() - Coordinates(0.3, -1, 0)).norm(), 0, 1e-13);
  EXPECT_NEAR(observed(body, "impulse_from_load_y"), -3 * m, 1e-13);
  EXPECT_EQ(observed(body, "impulse_from_clamps_y"), 0);
  EXPECT_NEAR(observed(body, "dissipated_energy"), 0, 1e-14);
}

TEST(RigidBody, SpinsForEverWithTheSameAngularMomentum) {
  Parameters p = bar();
  p.initial_velocity = InitialVelocity{
      .profile = VelocityProfile::linear, .origin = Vec(0.04, 0.01), .gradient = {{0, -7}, {7, 0}}};
  RigidBody body = rigid(coarse(p));
  const double first = angular_momentum(body), omega = body.velocities()[2];
  EXPECT_NEAR(omega, 7, 1e-13);
  step_to(body, 10, 1000);
  EXPECT_NEAR(angular_momentum(body) / first, 1, 1e-12);
  EXPECT_NEAR(body.coordinates()[2] / 70, 1, 1e-13);
  EXPECT_NEAR(body.coordinates().head<2>().norm(), 0, 1e-14);
  EXPECT_EQ(body.velocities()[2], omega);
  const Vec corner = body.body().X[0] - Vec(0.04, 0.01);
  const double angle = std::atan2(corner[1], corner[0]) + 70;
  const Vec place = Vec(0.04, 0.01) + corner.norm() * Vec(std::cos(angle), std::sin(angle));
  EXPECT_NEAR((body.body().X[0] + body.displacement(0) - place).norm(), 0, 1e-13);
}

/// x(t) of a mass m on a spring and a damper, let go at `x_0` [m].
double damped(double mass, double k, double c, double x_0, double t) {
  const double delta = 0.5 * c / mass, omega = std::sqrt(k / mass - delta * delta);
  return x_0 * std::exp(-delta * t) * (std::cos(omega * t) + delta / omega * std::sin(omega * t));
}

TEST(RigidBody, SwingsOnSpringsAndDampersToTheSecondOrder) {
  const Mounting mounting{.stiffness = Vec(40, 90),
                          .damping = Vec(1.5, 4),
                          .rest = Vec(0.01, -0.02),
                          .angular_stiffness = 0.03,
                          .angular_damping = 1e-3,
                          .rest_angle = 0.5};
  Coordinates last = Coordinates::Zero();
  for (const int count : {100, 200, 400}) {
    RigidBody body = rigid(coarse(mounted(mounting)));
    step_to(body, 1, count);
    const Coordinates exact(0.01 + damped(m, 40, 1.5, -0.01, 1), -0.02 + damped(m, 90, 4, 0.02, 1),
                            0.5 + damped(I, 0.03, 1e-3, -0.5, 1));
    const Coordinates error = (body.coordinates() - exact).cwiseAbs();
    for (int n = 0; n < 3 && count > 100; ++n) EXPECT_NEAR(std::log2(last[n] / error[n]), 2, 0.05) << n;
    last = error;
  }
  EXPECT_LT(last[2], 2e-4);
}

TEST(RigidBody, AccountsForTheEnergyThatADamperTakes) {
  RigidBody body = rigid(coarse(mounted(
      {.fixed = {"x", "angle"}, .stiffness = Vec(0, 90), .damping = Vec(0, 4), .rest = Vec(0, 0.02)})));
  EXPECT_EQ(observed(body, "dissipated_energy"), 0);
  EXPECT_NEAR(observed(body, "spring_energy"), 0.5 * 90 * 0.02 * 0.02, 1e-16);
  step_to(body, 8, 2000);
  EXPECT_NEAR(observed(body, "dissipated_energy") / (0.5 * 90 * 0.02 * 0.02), 1, 1e-6)
      << "it has come to rest";
  EXPECT_NEAR(body.coordinates()[1], 0.02, 1e-6);
}

TEST(RigidBody, KeepsItsEnergyOnSpringsAlone) {
  RigidBody body = rigid(coarse(mounted(
      {.stiffness = Vec(40, 90), .rest = Vec(0.01, -0.02), .angular_stiffness = 0.03, .rest_angle = 0.5})));
  const double all = observed(body, "spring_energy");
  double largest = 0;
  for (int n = 0; n < 1500; ++n) {
    body.advance(body.time_step_limit());
    largest = std::max(largest, std::abs(observed(body, "dissipated_energy")));
  }
  EXPECT_LT(largest / all, 1e-3) << "over many periods";
}

TEST(RigidBody, HoldsWhatIsFixed) {
  Scene scene = empty_scene();
  scene.gravity = Vec(3, -10);
  Parameters p = mounted({.fixed = {"y"}});
  p.initial_velocity = InitialVelocity{.velocity = Vec(1, 2)};
  RigidBody body = rigid(p, scene);
  step_to(body, 0.1, 10);
  EXPECT_EQ(body.coordinates()[1], 0);
  EXPECT_NEAR(body.coordinates()[0], 0.1 + 0.5 * 3 * 0.01, 1e-15);
  EXPECT_NEAR(observed(body, "impulse_from_clamps_y"), m * 10 * 0.1, 1e-13) << "its weight";
  EXPECT_NEAR(observed(body, "impulse_from_clamps_x"), 0, 1e-13);
}

TEST(RigidBody, SwingsAsAPendulumAboutItsPivot) {
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -10);
  scene.frame_interval = 1;
  RigidBody body = rigid(mounted({.fixed = {"x", "y"}, .pivot = Vec(0, 0.01)}), scene);  // horizontal
  const double about_pivot = I + m * 0.04 * 0.04, omega = std::sqrt(m * 10 * 0.04 / about_pivot);
  EXPECT_NEAR(body.inertia()[2], about_pivot, 1e-14);
  EXPECT_NEAR(observed(body, "kinetic_energy"), 0, 0);
  // From the horizontal: a period of 4 K(sin 45 deg)/omega; K = 1.8540746773.
  run_to(body, 2 * 1.8540746773 / omega);
  EXPECT_NEAR(body.coordinates()[2], -std::numbers::pi, 1e-3) << "half a period later, on the other side";
  EXPECT_NEAR(observed(body, "dissipated_energy") / (m * 10 * 0.04), 0, 1e-3);
}

TEST(RigidBody, TurnsAndShiftsUnderAForceBesideItsCentre) {
  RigidBody body = rigid(bar());
  const auto corner = static_cast<std::uint32_t>(body.particle_count() - 1);  // the upper right one
  const Vec arm = body.body().X[corner] - Vec(0.04, 0.01);
  EXPECT_NEAR((arm - Vec(0.0375, 0.0075)).norm(), 0, 1e-15);
  body.set_interface_load({corner}, load_of({Vec(2, -5)}));
  body.advance(1e-6);
  EXPECT_NEAR(body.velocities()[0] / 1e-6, 2 / m, 1e-9);
  EXPECT_NEAR(body.velocities()[1] / 1e-6, -5 / m, 1e-9);
  EXPECT_NEAR(body.velocities()[2] / 1e-6, (0.0375 * -5 - 0.0075 * 2) / I, 1e-6);
  step_to(body, 0.02, 200);
  EXPECT_NEAR(observed(body, "dissipated_energy") / observed(body, "interface_work"), 0, 1e-4);
  EXPECT_NEAR(body.impulses().loads[1], -5 * 0.020001, 1e-12);
}

TEST(RigidBody, AnswersAnImpedanceAtTheFaceThatFeelsIt) {
  // One step, worked by hand: z at the end of the bar, the fluid's copy going up at 1 m/s there.
  RigidBody body = rigid(bar());
  const auto corner = static_cast<std::uint32_t>(body.particle_count() - 1);
  InterfaceLoad load = load_of({Vec::Zero()});
  const double z = 300, r = 0.0375, dt = 1e-2;
  load.impedance = {0, z};
  load.velocity = {5, 1};
  body.set_interface_load({corner}, load);
  body.advance(dt);
  const double mobility = 1 / m + r * r / I;  // of the point, upwards
  const double w = 0.5 * dt * z * mobility / (1 + 0.5 * dt * z * mobility), impulse = dt * z * (1 - w);
  EXPECT_NEAR(body.excess_impulse()[1] / impulse, 1, 1e-13);
  EXPECT_EQ(body.excess_impulse()[0], 0);
  EXPECT_NEAR(body.velocities()[1] / (impulse / m), 1, 1e-13);
  EXPECT_NEAR(body.velocities()[2] / (r * impulse / I), 1, 1e-13);
  EXPECT_NEAR(body.work_of_excess_impulse(), impulse * w, 1e-15);
  EXPECT_NEAR(observed(body, "kinetic_energy"), impulse * w, 1e-14) << "the work of the impulse";
  // Whatever the step: what the fluid moves goes along with it in the end.
  RigidBody guided = rigid(mounted({.fixed = {"x", "angle"}}));
  guided.set_interface_load({corner}, load);
  step_to(guided, 200 * dt, 200);
  EXPECT_NEAR(guided.velocities()[1], 1, 1e-9);
}

TEST(RigidBody, RestsOnAWall) {
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -10);
  scene.walls = {{"floor", {Vec(-0.1, -0.05), Vec(0.2, 0)}, {}}};
  Parameters p = mounted({.damping = Vec(0, 200)});
  p.spacing = 0.01;
  p.wall_contact = Contact{.modulus = 1e5};
  RigidBody body = rigid(p, scene);
  run_to(body, 0.3);
  EXPECT_NEAR(body.velocities().norm(), 0, 1e-6);
  EXPECT_LT(body.coordinates()[1], 0);
  EXPECT_GT(body.coordinates()[1], -0.1 * p.spacing) << "pressed by 200 Pa";
  EXPECT_NEAR(body.coordinates()[2], 0, 1e-9);
}

TEST(RigidBodyRun, TakesAllOfABlow) {
  Scene scene = empty_scene();
  scene.frame_interval = 0.05;
  Parameters p = bar();
  for (const double length : {4e-4, 1e-9}) {  // a blow, and a force that jumps
    const Rows blow = length > 1e-6 ? Rows{{0.02, 0}, {0.02 + length, 1}, {0.02 + 2 * length, 0}}
                                    : Rows{{0.02, 0}, {0.02 + length, 1}};
    p.loads = {{.name = "blow", .box = {Vec(0, 0), Vec(1, 1)}, .force = Vec(0, 1000), .factor = blow}};
    RigidBody body = rigid(p, scene);
    run_to(body, 0.03);
    const double impulse = 1000 * (length > 1e-6 ? length : 0.01);
    EXPECT_NEAR(m * body.velocities()[1] / impulse, 1, 5e-3) << length;
    EXPECT_GE(body.time_step_limit(), 1e-6);
  }
}

TEST(RigidBodyRun, BouncesWithItsEnergy) {
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -10);
  scene.walls = {{"floor", {Vec(-0.1, -0.25), Vec(0.2, -0.05)}, {}}};
  for (const double modulus : {1e5, 1e6}) {
    Parameters p = mounted({.fixed = {"x", "angle"}});
    p.spacing = 0.01;
    p.wall_contact = Contact{.modulus = modulus};
    RigidBody body = rigid(p, scene);
    double least = 0, most = 0;
    for (int n = 1; n <= 100; ++n) {
      run_to(body, 0.01);
      const double lost = observed(body, "dissipated_energy");
      least = std::min(least, lost), most = std::max(most, lost);
    }
    EXPECT_GT(body.impulses().walls[1], 2 * m * 10 * 0.1) << "it has bounced";
    EXPECT_GT(least, -0.02 * m * 10 * 0.05) << modulus;
    EXPECT_LT(most, 0.02 * m * 10 * 0.05) << modulus;
  }
}

TEST(RigidBody, ResolvesWhatSwingsTurnsAndIsShown) {
  Scene scene = empty_scene();
  scene.frame_interval = 0.1;
  Parameters p = bar();
  p.time_step_share = 1;
  EXPECT_DOUBLE_EQ(rigid(p, scene).time_step_limit(), 0.1 / 20);
  p.mounting = Mounting{.stiffness = Vec(0, 1.6e4)};
  EXPECT_DOUBLE_EQ(rigid(p, scene).time_step_limit(), 0.05 / 100);
  p.mounting = Mounting{.damping = Vec(160, 0)};
  EXPECT_DOUBLE_EQ(rigid(p, scene).time_step_limit(), 0.05 / 100);
  p.mounting->fixed = {"x"};
  EXPECT_DOUBLE_EQ(rigid(p, scene).time_step_limit(), 0.1 / 20);
  scene.gravity_change = GravityChange{.sine = {Shake{{{.amplitude = 1, .frequency = 5}, Vec(1, 0)}}}};
  EXPECT_DOUBLE_EQ(rigid(p, scene).time_step_limit(), 0.05 / (10 * std::numbers::pi));
  p.loads = {{.name = "push", .box = {Vec(0, 0), Vec(1, 1)}, .force = Vec(0, 1), .sine = {Pulse{{1, 50}}}}};
  EXPECT_DOUBLE_EQ(rigid(p, scene).time_step_limit(), 0.05 / (100 * std::numbers::pi));
}

TEST(RigidBody, TellsWhatHoldsIt) {
  const auto told = [](const Mounting& mounting) {
    for (const auto& term : rigid(mounted(mounting)).active_terms())
      if (term.name == "mounting") return term.parameters;
    return std::string();
  };
  EXPECT_EQ(told({}), "holds nothing");
  EXPECT_EQ(told({.fixed = {"x"}, .damping = Vec(0, 3.2)}), "x fixed, decay time in y 0.5 s");
  EXPECT_EQ(told({.stiffness = Vec(0, 6.4), .damping = Vec(0, 3.2)}),
            "natural frequency in y 0.31831 Hz, damping ratio in y 0.5");
}

TEST(RigidBody, SharesItsWholeMassWithWhatTheFluidTouches) {
  const RigidBody body = rigid(bar());
  const Interface touched = body.interface(0.006);
  EXPECT_LT(touched.size(), body.particle_count());
  double sum = 0;
  for (const double mass : touched.mass) sum += mass;
  EXPECT_NEAR(sum, m, 1e-13);
}

TEST(RigidBody, ShowsNoStress) {
  const RigidBody body = rigid(bar());
  for (const auto& field : body.frame().fields) {
    EXPECT_NE(field.name, "stress");
    EXPECT_NE(field.name, "von_mises_stress");
    EXPECT_NE(field.name, "pressure");
  }
}

/// Two bars, one above the other, each a body of its own.
Parameters two_bars() {
  Parameters p = bar();
  p.materials = {{.name = "heavy", .elastic = {3000, 0, 0}}};
  p.regions[0].body = "lower";
  p.regions.push_back(
      {.name = "second", .box = {Vec(0, 0.1), Vec(0.08, 0.12)}, .material = "heavy", .body = "upper"});
  p.bodies = {{"lower"}, {"upper", Mounting{.fixed = {"x"}, .stiffness = Vec(0, 500)}}};
  return p;
}

TEST(RigidBody, IsOneOfSeveralWithAMassAndAMountingOfItsOwn) {
  Scene scene = empty_scene();
  scene.gravity = Vec(2, -10);
  RigidBody both = rigid(two_bars(), scene);
  EXPECT_NEAR(both.inertia(0)[0], m, 1e-14);
  EXPECT_NEAR(both.inertia(1)[0], 3 * m, 1e-13);
  EXPECT_NEAR(both.inertia(1)[2], 3 * I, 1e-15);
  step_to(both, 0.1, 2000);
  EXPECT_NEAR(both.coordinates(0)[0], 0.5 * 2 * 0.01, 1e-12);
  EXPECT_NEAR(both.coordinates(0)[1], -0.5 * 10 * 0.01, 1e-12);
  EXPECT_EQ(both.coordinates(1)[0], 0);
  const double omega = std::sqrt(500 / (3 * m));
  EXPECT_NEAR(both.coordinates(1)[1], -10 / (omega * omega) * (1 - std::cos(0.1 * omega)), 1e-7);
  EXPECT_EQ(observed(both, "lower_displacement_y"), both.coordinates(0)[1]);
  EXPECT_NEAR(observed(both, "upper_angular_velocity"), 0, 1e-10);
  EXPECT_NEAR(observed(both, "dissipated_energy"), 0, 1e-6);
}

TEST(RigidBody, MovesBitByBitAsAloneBesideAnother) {
  Parameters alone = two_bars();
  alone.regions.pop_back(), alone.bodies.pop_back();
  RigidBody both = rigid(two_bars()), single = rigid(alone);
  const Interface touched = single.interface(0.01);
  std::vector<Vec> forces;
  for (std::size_t n = 0; n < touched.size(); ++n) forces.emplace_back(std::cos(1.0 * n), std::sin(3.0 * n));
  for (RigidBody* body : {&both, &single}) {
    InterfaceLoad load = load_of(forces);
    for (std::size_t n = 0; n < touched.size(); ++n) {
      load.impedance.insert(load.impedance.end(), {0.0, 2.0});
      load.velocity.insert(load.velocity.end(), {0.1, -0.2});
    }
    body->set_interface_load(touched.id, load);
    step_to(*body, 0.05, 100);
  }
  EXPECT_EQ(both.coordinates(0), single.coordinates(0));
  EXPECT_GT(std::abs(single.coordinates(0)[2]), 1e-4);
  EXPECT_EQ(both.coordinates(1), Coordinates(0, 0, 0)) << "nothing has acted on it";
}

TEST(RigidBody, BringsTheMassOfItsOwnToItsInterface) {
  const RigidBody both = rigid(two_bars());
  const Interface touched = both.interface(0.006);
  Vec mass = Vec::Zero();
  for (std::size_t n = 0; n < touched.size(); ++n) mass[both.body().region[touched.id[n]]] += touched.mass[n];
  EXPECT_LT((mass - Vec(m, 3 * m)).norm(), 1e-12);
}

TEST(RigidBody, EndsTheRunWhereItMeetsAnother) {
  Scene scene = empty_scene();
  scene.gravity = Vec(0, 10);  // upwards, against the one on a spring
  RigidBody both = rigid(two_bars(), scene);
  try {
    for (double t = 0; t < 0.3; t += 1e-3) {
      both.advance(1e-3);
      both.check(t);
    }
    FAIL() << "they pass through each other";
  } catch (const PhysicsFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("rigid bodies do not push each other"), std::string::npos)
        << failure.what();
  }
}

}  // namespace
}  // namespace toryu::solid::of_rigid_bodies
