// What the elastic solid's interface and the fluid do to each other.
#include <gtest/gtest.h>
#include <omp.h>

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
        Contact{"Symplectic", WallSlip::no_slip, Friction{.coefficient = 0.3}, {}, Integrator::symplectic}),
    [](const auto& one) { return one.param.name; });

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

}  // namespace
}  // namespace toryu::fluid
