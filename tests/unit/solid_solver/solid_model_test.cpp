#include "solid_solver/solid_model.hpp"

#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>

#include "samples.hpp"
#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

namespace toryu::solid {
namespace {

Parameters in_form(Parameters p, Formulation formulation) {
  p.formulation = formulation;
  if (formulation == Formulation::updated_lagrangian) {
    p.hourglass.reset();
    p.artificial_viscosity = ArtificialViscosity{};
    p.artificial_stress = ArtificialStress{};
  }
  return p;
}

class BothForms : public testing::TestWithParam<Formulation> {};
INSTANTIATE_TEST_SUITE_P(Solid, BothForms,
                         testing::Values(Formulation::total_lagrangian, Formulation::updated_lagrangian),
                         [](const auto& form) {
                           return form.param == Formulation::total_lagrangian ? "total" : "updated";
                         });

TEST_P(BothForms, KeepsMomentumOfAFreeBody) {
  Parameters p = in_form(moving_cantilever(4, 3.0), GetParam());
  p.clamps.clear();
  const auto model = model_of(p);
  const double x = observed(*model, "momentum_x"), y = observed(*model, "momentum_y");
  const double turning = angular_momentum(*model);
  run_to(*model, 0.01);
  EXPECT_GT(std::abs(model->displacement(15)[1]), 0.01) << "it moved by several spacings";
  EXPECT_NEAR(observed(*model, "momentum_x"), x, 1e-12 * std::abs(y));
  EXPECT_NEAR(observed(*model, "momentum_y") / y, 1.0, 1e-12);
  // The pair forces of the updated form are not central: it keeps angular momentum only as far as it
  // converges.
  if (GetParam() == Formulation::total_lagrangian) {
    EXPECT_NEAR(angular_momentum(*model) / turning, 1.0, 1e-11);
  }
}

TEST_P(BothForms, IsBitwiseTheSameForOneAndTwoThreads) {
  const auto run = [&](int threads) {
    omp_set_num_threads(threads);
    auto model = model_of(in_form(moving_cantilever(6, 2.0), GetParam()));
    run_to(*model, 0.001);
    return model;
  };
  const auto one = run(1), two = run(2);
  omp_set_num_threads(1);
  for (std::size_t i = 0; i < one->particle_count(); ++i) {
    ASSERT_EQ(one->displacement(i), two->displacement(i));
    ASSERT_EQ(one->velocity(i), two->velocity(i));
  }
}

TEST_P(BothForms, HoldsTheClampedAndTakesTheirLoad) {
  Parameters p = in_form(moving_cantilever(4, 1.0), GetParam());
  const auto model = model_of(p);
  const Interface interface = model->interface(0.011);
  InterfaceLoad load;
  load.pressure.assign(interface.size(), 0.0);
  for (std::size_t n = 0; n < interface.size(); ++n) load.force.insert(load.force.end(), {0.25, -1.0});
  const Vec taken = model->set_interface_load(interface.id, load);
  EXPECT_EQ(taken, static_cast<double>(interface.size()) * Vec(0.25, -1.0)) << "clamped particles included";
  run_to(*model, 0.002);
  for (const auto i : model->body().inside(p.clamps[0].box)) {
    EXPECT_EQ(model->displacement(i), Vec(0, 0));
    EXPECT_EQ(model->acceleration(i), Vec(0, 0));
  }
  EXPECT_NE(model->displacement(model->particle_count() - 1), Vec(0, 0));
}

TEST_P(BothForms, ImpulsesOfLoadsWallsAndClampsSumToTheChangeOfMomentum) {
  Parameters p = in_form(moving_cantilever(4, 2.0), GetParam());
  p.loads = {{"tip", {Vec(0.06, -1), Vec(1, 1)}, Vec(-30.0, -50.0)}};
  p.wall_contact = Contact{};
  Scene scene = empty_scene();
  scene.gravity = Vec(1, -10);
  scene.walls = {{.name = "floor", .box = {Vec(-0.05, -0.04), Vec(0.13, -0.002)}, .motion = {}}};
  const auto model = model_of(p, scene);
  const Interface interface = model->interface(0.006);
  InterfaceLoad load;
  load.pressure.assign(interface.size(), 0.0);
  const auto momentum = [&] { return Vec(observed(*model, "momentum_x"), observed(*model, "momentum_y")); };
  const Vec start = momentum();
  double largest = 0;
  for (int window = 0; window < 40; ++window) {
    load.force.clear();
    for (std::size_t n = 0; n < interface.size(); ++n)
      load.force.insert(load.force.end(), {1.0 - window % 3, -2.0 - window % 5});
    model->set_interface_load(interface.id, load);
    run_to(*model, 5e-4);
    const Impulses& given = model->impulses();
    for (const Vec& impulse : {given.loads, given.walls, given.clamps})
      largest = std::max(largest, impulse.norm());
    ASSERT_LT((momentum() - start - given.loads - given.walls - given.clamps).norm(), 1e-10 * largest);
  }
  EXPECT_GT(model->impulses().walls[1], 0.05 * largest) << "it fell on the floor";
  EXPECT_GT(model->impulses().clamps.norm(), 0.05 * largest);
  EXPECT_EQ(observed(*model, "impulse_from_walls_y"), model->impulses().walls[1]);
  EXPECT_EQ(observed(*model, "impulse_from_load_x"), model->impulses().loads[0]);
  EXPECT_EQ(observed(*model, "impulse_from_clamps_y"), model->impulses().clamps[1]);
}

/// A load without force whose impedance `z` brakes the normal velocity of a free plate against `velocity`.
InterfaceLoad impedance_load(const Interface& interface, double z, const Vec& velocity) {
  InterfaceLoad load;
  load.pressure.assign(interface.size(), 0.0);
  load.force.assign(dim * interface.size(), 0.0);
  for (std::size_t n = 0; n < interface.size(); ++n) {
    load.impedance.insert(load.impedance.end(), {0.0, z});
    load.velocity.insert(load.velocity.end(), {velocity[0], velocity[1]});
  }
  return load;
}

TEST_P(BothForms, IsBrakedByAnImpedanceAlongItsNormal) {
  const auto model = model_of(in_form(free_plate(4), GetParam()));
  const Interface interface = model->interface(1);  // all particles: the plate moves as one
  const double z = 5e3 * model->mass(0);            // a rate of 5000/s
  model->set_interface_load(interface.id, impedance_load(interface, z, Vec(3, 2)));
  run_to(*model, 1e-4);
  EXPECT_NEAR(model->velocity(7)[1], 2 * (1 - std::exp(-0.5)), 0.01);
  EXPECT_NEAR(model->velocity(7)[0], 0, 1e-12) << "nothing acts aside";
  double impulse = 0, momentum = 0;
  const auto taken = model->excess_impulse();
  for (std::size_t n = 0; n < interface.size(); ++n) {
    impulse += taken[dim * n + 1];
    momentum += model->mass(interface.id[n]) * model->velocity(interface.id[n])[1];
  }
  EXPECT_NEAR(impulse / momentum, 1, 1e-12);
  EXPECT_NEAR(model->impulses().loads[1] / momentum, 1, 1e-12);
}

TEST(Impedance, OfAnySizeBrakesWithoutSwinging) {
  const auto model = model_of(free_plate(4));
  const Interface interface = model->interface(1);
  const double dt = model->time_step_limit(), z = 1e3 * model->mass(0) / dt;
  model->set_interface_load(interface.id, impedance_load(interface, z, Vec(0, 2)));
  for (int n = 0; n < 50; ++n) model->advance(dt);
  const double way = model->displacement(7)[1];
  EXPECT_NEAR(way / (2 * 50 * dt), 1, 0.01) << "it goes with the fluid";
  const auto taken = model->excess_impulse();
  EXPECT_NEAR(taken[1] / (z * (2 * 50 * dt - way)), 1, 1e-6) << "z (w_c t - u)";
}

TEST_P(BothForms, FallsFreelyUnderGravity) {
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -10);
  const auto model = model_of(in_form(free_plate(4), GetParam()), scene);
  run_to(*model, 0.01);
  EXPECT_NEAR(model->velocity(7)[1], -0.1, 1e-12);
  EXPECT_NEAR(model->displacement(7)[1], -5e-4, 1e-12);
  EXPECT_NEAR(observed(*model, "dissipated_energy"), 0, 1e-12);
}

TEST_P(BothForms, StopsWhereAValueLeavesPhysics) {
  Parameters p = in_form(free_plate(4), GetParam());
  p.initial_velocity = InitialVelocity{.velocity = Vec(3, 4)};
  p.limits.speed = 4.9;
  const auto failure = [](const SolidModel& model) -> std::string {
    try {
      model.check(0.25);
    } catch (const PhysicsFailure& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(failure(*model_of(p)), "solid particle 0 at t = 0.25 s: speed = 5 m/s, limit 4.9 m/s");
  p.limits.speed = 0;
  EXPECT_EQ(failure(*model_of(p)), "");
  Scene scene = empty_scene();
  scene.domain.max = Vec(0.05, 1);
  EXPECT_THAT(failure(*model_of(p, scene)),
              testing::MatchesRegex(
                  "solid particle [0-9]+ at t = 0.25 s: position = .0.0525, 0.0[0-9]+. m, "
                  "limit the domain of the case, .-1, -1. to .0.05, 1. m; a ..solid.clamp.. holds it, or a "
                  "larger .case. domain lets it go on"));
  p.initial_velocity->velocity = Vec(std::nan(""), 0);
  EXPECT_THAT(failure(*model_of(p)),
              testing::StartsWith("solid particle 0 at t = 0.25 s: speed = not a number,"));
}

TEST_P(BothForms, BouncesOffAWallAndDoesNotStick) {
  Parameters p = in_form(free_plate(4), GetParam());
  p.initial_velocity = InitialVelocity{.velocity = Vec(0, -1)};
  p.wall_contact = Contact{};
  p.time_step_share =
      0.2;  // the impact's energy is in the fastest modes, of which the leapfrog keeps a neighbour
  Scene scene = empty_scene();
  scene.walls = {{.name = "floor", .box = {Vec(-0.05, -0.03), Vec(0.13, -0.005)}, .motion = {}}};
  const auto model = model_of(p, scene);
  double lowest = 1, largest_contact = 0;
  for (double t = 0; t < 0.02; t += 2.5e-4) {
    run_to(*model, 2.5e-4);
    largest_contact = std::max(largest_contact, observed(*model, "contact_energy"));
    for (std::size_t i = 0; i < 16; ++i) lowest = std::min(lowest, 0.0025 + model->displacement(i)[1]);
  }
  EXPECT_GT(largest_contact, 0.05 * 0.5 * 1.6);
  EXPECT_GT(lowest, -0.005 - 0.0025)
      << "the wall's face is at -0.005, the lowest row 2.5 mm above the body's";
  EXPECT_GT(observed(*model, "momentum_y"), 0.5 * 1.6) << "it came back";
  EXPECT_EQ(observed(*model, "contact_energy"), 0) << "and left";
  if (GetParam() == Formulation::total_lagrangian) {
    EXPECT_NEAR(observed(*model, "dissipated_energy"), 0, 5e-3 * 0.5 * 1.6);
  } else {
    EXPECT_GT(observed(*model, "dissipated_energy"), 0);
  }
}

TEST(TotalLagrangian, KeepsTheEnergyOfALargeVibration) {
  auto p = moving_cantilever(4, 4.0);
  const auto model = model_of(p);
  const double energy = observed(*model, "kinetic_energy");
  run_to(*model, 0.05);
  EXPECT_GT(observed(*model, "hourglass_energy"), 0);
  EXPECT_NEAR(observed(*model, "dissipated_energy") / energy, 0, 2e-3);
}

TEST(TotalLagrangian, ViscosityTakesEnergyAndNoMomentum) {
  Parameters p = moving_cantilever(4, 3.0);
  p.clamps.clear();
  p.artificial_viscosity = ArtificialViscosity{.alpha = 0.5, .beta = 0.0};
  const auto model = model_of(p);
  const double y = observed(*model, "momentum_y"), turning = angular_momentum(*model);
  run_to(*model, 0.01);
  EXPECT_GT(observed(*model, "dissipated_energy"), 0);
  EXPECT_NEAR(observed(*model, "momentum_y") / y, 1.0, 1e-12);
  EXPECT_NEAR(angular_momentum(*model) / turning, 1.0, 1e-11);
}

TEST(TotalLagrangian, HighestFrequencyIsThatOfTheStabilityLimit) {
  Parameters p = moving_cantilever(4, 1e-6);
  const auto energy_after = [&](double share) {
    auto parameters = p;
    parameters.time_step_share = share;
    TotalLagrangian model(parameters, body_of(parameters), empty_scene());
    const double dt = model.time_step_limit();
    for (int n = 0; n < 1500; ++n) model.advance(dt);
    return observed(model, "kinetic_energy");
  };
  EXPECT_LT(energy_after(0.97), 1e-9);
  EXPECT_FALSE(energy_after(1.03) < 1.0);
}

TEST(SolidModel, ConstantLoadsAreSharedByTheParticlesOfTheirBox) {
  Parameters p = free_plate(4);
  p.loads = {{"pull", {Vec(0.06, -1), Vec(1, 1)}, Vec(8.0, 0)}};
  const auto model = model_of(p);
  EXPECT_NEAR(model->acceleration(15)[0], 8.0 / (16 * model->mass(15)), 1e-12);
  EXPECT_EQ(model->acceleration(0), Vec(0, 0));
  run_to(*model, 1e-3);
  EXPECT_NEAR(observed(*model, "momentum_x"), 8.0e-3, 1e-12);
}

TEST(SolidModel, RegionsHaveVelocitiesOfTheirOwnAndTellThem) {
  Parameters p = free_plate(4);
  p.initial_velocity = InitialVelocity{.velocity = Vec(1, 2)};
  p.regions.push_back({.name = "other",
                       .box = {Vec(0.2, 0), Vec(0.24, 0.02)},
                       .initial_velocity = InitialVelocity{.velocity = Vec(-3, 0.5)},
                       .observed = true});
  const auto model = model_of(p);
  EXPECT_EQ(model->velocity(0), Vec(1, 2));
  EXPECT_NEAR(observed(*model, "other_velocity_x"), -3, 1e-12);
  run_to(*model, 0.01);
  EXPECT_NEAR(observed(*model, "other_velocity_y"), 0.5, 1e-12);
  EXPECT_NEAR(observed(*model, "other_displacement_x"), -0.03, 1e-12);
}

TEST(SolidModel, WorkOfTheInterfaceLoadIsInTheBalance) {
  const auto model = model_of(moving_cantilever(4, 0.0));
  const Interface interface = model->interface(0.011);
  for (int window = 0; window < 20; ++window) {
    InterfaceLoad load;
    load.pressure.assign(interface.size(), 0.0);
    for (std::size_t n = 0; n < interface.size(); ++n)
      load.force.insert(load.force.end(), {0.0, 1.0 + window % 3});
    model->set_interface_load(interface.id, load);
    run_to(*model, 2e-4);
  }
  const double work = observed(*model, "interface_work");
  EXPECT_GT(work, 1e-4);
  EXPECT_NEAR(observed(*model, "dissipated_energy") / work, 0, 1e-3);
}

TEST(Stress, VonMisesOfPureShearIsRootThreeTimesIt) {
  EXPECT_NEAR((Stress{.xy = 2.0}.von_mises()), 2.0 * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR((Stress{.xx = 3.0, .yy = 3.0, .zz = 3.0}.von_mises()), 0.0, 1e-15);
  EXPECT_EQ((Stress{.xx = 3.0, .yy = 3.0, .zz = 3.0}.pressure()), -3.0);
}

}  // namespace
}  // namespace toryu::solid
