// What the elastic solid's interface and the fluid do to each other.
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>

#include "fluid_solver/moving_interface.hpp"
#include "tests/unit/fluid_solver/plate.hpp"

namespace toryu::fluid {
namespace {

struct Contact {
  std::string name;
  WallSlip slip;
  std::optional<Friction> friction;
  std::optional<PowerLaw> power_law = {};
  Integrator integrator = Integrator::midpoint;
  std::optional<Viscoelasticity> viscoelasticity = {};
};
class Exchange : public testing::TestWithParam<Contact> {};

TEST_P(Exchange, GivesThePlateWhatItTakesFromTheFluid) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  setting.parameters.wall_model.slip = GetParam().slip;
  setting.parameters.friction = GetParam().friction;
  setting.parameters.integrator = GetParam().integrator;
  setting.parameters.viscoelasticity = GetParam().viscoelasticity;
  if (GetParam().power_law) {
    setting.parameters.laminar_viscosity.reset();
    setting.parameters.power_law = GetParam().power_law;
  }
  WeaklyCompressible solver = setting.solver();
  const Interface interface = plate();
  solver.attach(interface);
  const Vec v(0.2, 0.1);
  for (int n = 0; n < 30; ++n) {
    const double dt = 0.5 * solver.time_step_limit();
    solver.begin_window(moved(interface, v, solver.time()), 2 * dt);
    solver.advance(dt);
    solver.advance(dt);
    const InterfaceLoad load = solver.take_load();
    Vec on_plate = Vec::Zero(), friction = Vec::Zero();
    double size = 0;
    for (std::size_t k = 0; k < interface.size(); ++k) {
      Vec force(load.force[dim * k], load.force[dim * k + 1]);
      if (GetParam().friction) {
        friction += Vec(load.friction_force[dim * k], load.friction_force[dim * k + 1]);
        force += Vec(load.friction_force[dim * k], load.friction_force[dim * k + 1]);
      }
      on_plate += 2 * dt * force;
      size += 2 * dt * force.norm();
    }
    ASSERT_GT(on_plate[0], 0);
    if (GetParam().friction)
      EXPECT_LT(friction[1], 0);  // the plate rises past the water
    else
      EXPECT_TRUE(load.friction_force.empty());
    EXPECT_LT((on_plate + load.impulse_on_fluid).norm(), 1e-13 * size) << "window " << n;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Walls, Exchange,
    testing::Values(
        Contact{"NoSlip", WallSlip::no_slip, {}}, Contact{"FreeSlip", WallSlip::free_slip, {}},
        Contact{"NoSlipThinning", WallSlip::no_slip, {}, PowerLaw{3.0, 0.5, 0.1, 30.0}},
        Contact{"FreeSlipThinning", WallSlip::free_slip, {}, PowerLaw{3.0, 0.5, 0.1, 30.0}},
        Contact{"Friction", WallSlip::free_slip, Friction{.coefficient = 0.3}},
        Contact{"FrictionAsPrinted", WallSlip::no_slip,
                Friction{.coefficient = 0.3, .form = FrictionForm::as_printed}},
        Contact{"Symplectic", WallSlip::no_slip, Friction{.coefficient = 0.3}, {}, Integrator::symplectic},
        Contact{"Viscoelastic",
                WallSlip::no_slip,
                {},
                {},
                Integrator::symplectic,
                Viscoelasticity{{{0.01, 30, 0.1}}}}),
    [](const auto& one) { return one.param.name; });

class ImpedancePlate : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Steps, ImpedancePlate,
                         testing::Values(Integrator::midpoint, Integrator::symplectic));

TEST_P(ImpedancePlate, GivesTheImpulseItIsAskedForToRounding) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  setting.parameters.integrator = GetParam();
  WeaklyCompressible solver = setting.solver();
  const Interface interface = plate();
  solver.attach(interface);
  const double dt = 0.5 * solver.time_step_limit();
  InterfaceMotion motion = moved(interface, Vec::Zero(), 0);
  motion.impulse.assign(dim * interface.size(), 0.0);
  solver.begin_window(motion, dt);
  solver.advance(dt);
  solver.take_load();
  Vec asked = Vec::Zero();
  for (std::size_t k = 0; k < interface.size(); ++k) {
    motion.impulse[dim * k] = 0.1 + 0.01 * static_cast<double>(k);
    motion.impulse[dim * k + 1] = -0.02;
    asked += vector_of(motion.impulse, k);
  }
  const Vec momentum = solver.momentum();
  const double energy = solver.kinetic_energy();
  solver.begin_window(motion, dt);
  const Vec received = solver.momentum() - momentum;
  const double gained = solver.kinetic_energy() - energy;
  solver.advance(dt);
  const InterfaceLoad load = solver.take_load();
  EXPECT_NEAR(load.work_of_impulse, gained, 1e-12 * std::abs(gained));
  Vec on_plate = asked;
  for (std::size_t k = 0; k < interface.size(); ++k) {
    const Vec force = vector_of(load.force, k);
    on_plate += dt * force;
    if (load.impedance[dim * k] == 0) {  // the outer columns: nothing in reach, so the load takes it back
      EXPECT_LT((dt * force + vector_of(motion.impulse, k)).norm(), 1e-14);
      asked -= vector_of(motion.impulse, k);
    }
  }
  EXPECT_LT((received + asked).norm(), 1e-12 * asked.norm());
  EXPECT_LT((on_plate + load.impulse_on_fluid).norm(), 1e-12 * on_plate.norm());
}

TEST(Impedance, OfAPlaneFaceIsThatOfItsArea) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  WeaklyCompressible solver = setting.solver();
  const Interface interface = plate();
  solver.attach(interface);
  const double dt = 1e-6;
  InterfaceMotion motion = moved(interface, Vec::Zero(), 0);
  motion.impulse.assign(dim * interface.size(), 0.0);
  solver.begin_window(motion, dt);
  solver.advance(dt);
  const auto z = solver.take_load().impedance;
  Vec sum = Vec::Zero();
  for (std::size_t k = 0; k < interface.size(); ++k)
    if (interface.position[dim * k + 1] > 0.2 && interface.position[dim * k + 1] < 0.3)
      sum += vector_of(z, k);
  const double whole = 0.1 * setting.parameters.density * setting.parameters.sound_speed;  // of 0.1 m
  EXPECT_NEAR(sum[0] / whole, -1.0, 0.05) << "outward is to the left";
  EXPECT_NEAR(sum[1] / whole, 0.0, 0.01);
}

TEST(Interface, HasNoImpedanceUnlessAskedFor) {
  Setting setting = tank_with_a_plate();
  WeaklyCompressible solver = setting.solver();
  const Interface interface = plate();
  solver.attach(interface);
  solver.begin_window(moved(interface, Vec::Zero(), 0), 1e-6);
  solver.advance(1e-6);
  EXPECT_TRUE(solver.take_load().impedance.empty());
}

TEST(MovingInterface, BeginsWhereTheSolidIsIfTheMotionHasAnImpulse) {
  const Interface interface = plate();
  MovingInterface copy(interface, 1);
  copy.begin_window(moved(interface, Vec(1, 0), 0.1), 0, 0.1);
  EXPECT_NEAR(copy.at(0.1)(0).x[0], interface.position[0] + 0.1, 1e-15);
  InterfaceMotion next = moved(interface, Vec(2, 0), 0.1);  // the solid has got to 0.08 only
  for (std::size_t k = 0; k < interface.size(); ++k)
    next.position[dim * k] = interface.position[dim * k] + 0.28;
  next.impulse.assign(dim * interface.size(), 0.0);
  copy.begin_window(next, 0.1, 0.1);
  EXPECT_NEAR(copy.at(0.1)(0).x[0], interface.position[0] + 0.08, 1e-15);
  EXPECT_NEAR(copy.at(0.1)(0).v[0], 2, 1e-12);
  EXPECT_NEAR(copy.at(0.2)(0).x[0], interface.position[0] + 0.28, 1e-15);
}

TEST(RigidInterface, TurnsItsFacesWithIt) {
  const Interface interface = plate();
  for (const bool rigid : {false, true}) {
    Setting setting = tank_with_a_plate();
    WeaklyCompressible solver = setting.solver();
    solver.attach(interface, rigid);
    InterfaceMotion motion = moved(interface, Vec::Zero(), 0);
    for (const double angle : {0.0, 0.5, 3.0, -2.0}) {
      const Pose pose{.about = Vec(0.5, 0.5),
                      .centre = Vec(0.7, 0.4),
                      .angle = angle,
                      .rotation = Eigen::Rotation2Dd(angle).toRotationMatrix()};
      for (std::size_t k = 0; k < interface.size(); ++k) {
        const Vec x = pose.place(vector_of(interface.position, k));
        motion.position[dim * k] = x[0], motion.position[dim * k + 1] = x[1];
      }
      solver.begin_window(motion, 1e-6);
      const Boundary& boundary = solver.boundaries().back();
      const Vec normal(0.6, -0.8), expected = rigid ? pose.turned(normal) : normal;
      EXPECT_LT((boundary.turned(normal) - expected).norm(), 1e-13) << angle;
      EXPECT_LT((boundary.turned_back(expected) - normal).norm(), 1e-13) << angle;
    }
  }
}

TEST(GrazedPlate, TakesWhatItGivesToRoundingOfThatLittle) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  WeaklyCompressible solver = setting.solver();
  Interface interface = plate();
  // The first columns, of water at 0.475 m and of the plate; their rows are 0.0125 m off each other.
  const double apart = std::sqrt(solver.reach() * solver.reach() - 0.0125 * 0.0125) - 1e-5;
  for (std::size_t k = 0; k < interface.size(); ++k) interface.position[dim * k] += 0.475 + apart - 0.5125;
  solver.attach(interface);
  const double dt = 1e-6;
  solver.begin_window(moved(interface, Vec::Zero(), 0), dt);
  solver.advance(dt);
  const InterfaceLoad load = solver.take_load();
  Vec on_plate = Vec::Zero();
  double size = 0;
  for (std::size_t k = 0; k < interface.size(); ++k) {
    const Vec force(load.force[dim * k], load.force[dim * k + 1]);
    on_plate += dt * force;
    size += dt * force.norm();
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(size, 1e-4 * dt) << "of some 10 N/m that it bears in contact";
  EXPECT_LT((on_plate + load.impulse_on_fluid).norm(), 1e-13 * size);
}

TEST(Plate, MayNotStandWhereFluidIs) {
  WeaklyCompressible solver = tank_with_a_plate().solver();
  Interface inside = plate();
  for (std::size_t k = 0; k < inside.size(); ++k) inside.position[dim * k] -= 0.1;
  EXPECT_THROW(solver.attach(inside), BadInput);
}

TEST(PlateAtRest, BearsThePressureOfTheWater) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  setting.parameters.regions.front().box.max = Vec(0.5, 0.5);
  setting.parameters.hydrostatic_start = HydrostaticStart{0.5};
  setting.parameters.artificial_viscosity->alpha = 0.3;
  WeaklyCompressible solver = setting.solver();
  const Interface interface = plate();
  solver.attach(interface);
  double impulse = 0, time = 0;
  while (solver.time() < 0.8) {
    const double dt = solver.time_step_limit();
    solver.begin_window(moved(interface, Vec(0, 0), 0), dt);
    solver.advance(dt);
    const InterfaceLoad load = solver.take_load();
    if (solver.time() < 0.4) continue;
    for (std::size_t k = 0; k < interface.size(); ++k) impulse += dt * load.force[dim * k];
    time += dt;
  }
  const double expected = 0.5 * 1000 * 9.81 * 0.5 * 0.5;  // 1/2 rho g H^2
  // The floor goes on under the plate and bears the corner's share: the pressure at the bottom on about a
  // quarter of a spacing, 0.045 of the whole with ten rows.
  EXPECT_NEAR(impulse / time, 0.955 * expected, 0.02 * expected);
}

TEST(Interface, StandsForTheWallThatItLiesIn) {
  omp_set_num_threads(1);
  const auto run = [](std::vector<Wall> walls) {
    Setting setting = tank_with_a_plate();
    for (Wall& wall : walls) setting.scene.walls.push_back(std::move(wall));
    WeaklyCompressible solver = setting.solver();
    const Interface interface = plate();
    solver.attach(interface);
    for (int n = 0; n < 20; ++n) {
      const double dt = 0.5 * solver.time_step_limit();
      solver.begin_window(moved(interface, Vec::Zero(), solver.time()), dt);
      solver.advance(dt);
      solver.take_load();
    }
    return std::pair(positions(solver), solver.boundaries().size());
  };
  const auto alone = run({}), in_wall = run({{"right", {Vec(0.5, 0), Vec(0.65, 0.6)}, {}}});
  EXPECT_EQ(largest_difference(alone.first, in_wall.first), 0);
  Wall work_piece{"right", {Vec(0.5, 0), Vec(0.65, 0.6)}, {}};
  work_piece.work_piece = true;
  const auto in_work_piece = run({work_piece});
  EXPECT_EQ(largest_difference(alone.first, in_work_piece.first), 0);
  EXPECT_EQ(in_work_piece.second, 2u) << "nothing of the wall is left";
}

}  // namespace
}  // namespace toryu::fluid
