// What the elastic solid's interface and the fluid do to each other.
#include "fluid_solver/interface.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

/// Six columns of particles that stand in the place of the tank's right wall, finer than the fluid.
Interface plate() {
  Interface plate;
  plate.spacing = 0.025;
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 6; ++column) {
      plate.id.push_back(static_cast<std::uint32_t>(plate.id.size()));
      plate.position.push_back(0.5 + (column + 0.5) * plate.spacing);
      plate.position.push_back((row + 0.5) * plate.spacing);
      plate.volume.push_back(plate.spacing * plate.spacing);
      plate.area_vector.insert(plate.area_vector.end(), {column == 0 ? -plate.spacing : 0, 0});
    }
  return plate;
}

/// The plate moved by v t at time t.
InterfaceMotion moved(const Interface& plate, const Vec& v, double t) {
  InterfaceMotion motion{plate.position, {}};
  for (std::size_t k = 0; k < plate.size(); ++k) {
    motion.position[dim * k] += v[0] * t;
    motion.position[dim * k + 1] += v[1] * t;
    motion.velocity.insert(motion.velocity.end(), {v[0], v[1]});
  }
  return motion;
}

Setting tank_with_a_plate() {
  Setting setting = collapsing_column();
  setting.scene.walls.pop_back();
  setting.parameters.hydrostatic_start = HydrostaticStart{0.8};
  setting.parameters.laminar_viscosity = LaminarViscosity{3.0};
  return setting;
}

struct Contact {
  std::string name;
  WallSlip slip;
  std::optional<Friction> friction;
  std::optional<PowerLaw> power_law = {};
  Integrator integrator = Integrator::midpoint;
};
class Exchange : public testing::TestWithParam<Contact> {};

TEST_P(Exchange, GivesThePlateWhatItTakesFromTheFluid) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  setting.parameters.wall_model.slip = GetParam().slip;
  setting.parameters.friction = GetParam().friction;
  setting.parameters.integrator = GetParam().integrator;
  if (GetParam().power_law) {
    setting.parameters.laminar_viscosity.reset();
    setting.parameters.power_law = GetParam().power_law;
  }
  FluidSolver solver = setting.solver();
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
        Contact{"Symplectic", WallSlip::no_slip, Friction{.coefficient = 0.3}, {}, Integrator::symplectic}),
    [](const auto& one) { return one.param.name; });

TEST(GrazedPlate, TakesWhatItGivesToRoundingOfThatLittle) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  FluidSolver solver = setting.solver();
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

/// Ten windows beside the plate, in which the lists are built anew; the loads of all of them.
std::vector<double> loads_of_ten_windows(FluidSolver& solver, const Interface& interface) {
  std::vector<double> loads;
  for (int n = 0; n < 10; ++n) {
    const double dt = solver.time_step_limit();
    solver.begin_window(moved(interface, Vec(0.2, 0.1), solver.time()), dt);
    solver.advance(dt);
    const InterfaceLoad load = solver.take_load();
    loads.insert(loads.end(), load.force.begin(), load.force.end());
  }
  return loads;
}

TEST(RepeatedWindow, IsBitwiseTheSame) {
  omp_set_num_threads(1);
  Setting setting = tank_with_a_plate();
  setting.parameters.friction = Friction{.coefficient = 0.3};
  setting.parameters.neighbour_skin = 0.01;
  FluidSolver solver = setting.solver();
  const Interface interface = plate();
  solver.attach(interface);
  loads_of_ten_windows(solver, interface);
  solver.save();
  const long builds = solver.list_builds();
  const auto first = loads_of_ten_windows(solver, interface);
  EXPECT_GT(solver.list_builds(), builds) << "the order of the particles has changed";
  const auto places = positions(solver);
  const auto told = solver.observe();
  for (int repeat = 0; repeat < 2; ++repeat) {
    solver.restore();
    ASSERT_EQ(loads_of_ten_windows(solver, interface), first);
    ASSERT_EQ(positions(solver), places);
    const auto again = solver.observe();
    for (std::size_t k = 0; k < told.size(); ++k) ASSERT_EQ(again[k].value, told[k].value) << told[k].name;
  }
}

TEST(Plate, MayNotStandWhereFluidIs) {
  FluidSolver solver = tank_with_a_plate().solver();
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
  FluidSolver solver = setting.solver();
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

}  // namespace
}  // namespace toryu::fluid
