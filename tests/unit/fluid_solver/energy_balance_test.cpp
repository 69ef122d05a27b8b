// Where the energy of the fluid goes: powers worked by hand, and balances that must close.
#include "fluid_solver/energy_balance.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/plate.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

/// Two particles that approach askew, 0.05 m apart, before and after a step that moves them by nothing.
struct TwoParticles {
  Setting setting = empty_space();
  TwoParticles() {
    auto& p = setting.parameters;
    p.density_diffusion.reset();
    p.artificial_viscosity.reset();
    p.regions = {{"left", {Vec(0, 0), Vec(0.05, 0.05)}, Vec(1, 0.5)},
                 {"right", {Vec(0.05, 0), Vec(0.1, 0.05)}, Vec(-2, 0.25)}};
  }
  double h() const { return setting.parameters.h(); }
  double m() const { return 1000 * 0.05 * 0.05; }
  Vec gradient() const { return grad_W(Vec(0, 0), Vec(0.05, 0), h()); }
  double power() {
    WeaklyCompressible solver = setting.solver();
    solver.advance(1e-12);
    EXPECT_EQ(solver.powers().size(), 2u);
    EXPECT_EQ(solver.powers().back().term, "pressure");
    EXPECT_NEAR(solver.powers().back().value, 0, 1e-9) << "between like densities";
    return solver.powers().front().value;
  }
};

TEST(Power, OfArtificialViscosityIsThatOfItsPairForce) {
  TwoParticles two;
  two.setting.parameters.artificial_viscosity = ArtificialViscosity{0.3, 0.7};
  const double h = two.h(), m = two.m(), v_x = 3 * -0.05, r2 = 0.05 * 0.05;  // v_ij . x_ij
  const double theta = h * v_x / (r2 + 0.01 * h * h);
  const double Pi = (-0.3 * 20 * theta + 0.7 * theta * theta) / 1000;
  const Vec force = -m * m * Pi * two.gradient();  // on the left one, v_ij = (3, 0.25)
  EXPECT_NEAR(two.power(), -force.dot(Vec(3, 0.25)), 1e-8 * two.power());
  EXPECT_GT(two.power(), 0);
}

TEST(Power, OfViscosityIsThatOfItsPairForce) {
  TwoParticles two;
  two.setting.parameters.laminar_viscosity = LaminarViscosity{5};
  const double m = two.m(), slope = two.gradient().dot(Vec(-0.05, 0)) / (0.05 * 0.05);
  const Vec v_ij(3, 0.25), force = m * m * 2 * 5 / 1e6 * slope * v_ij;
  EXPECT_NEAR(two.power(), -force.dot(v_ij), 1e-8 * two.power());
  EXPECT_GT(two.power(), 0);
}

TEST(Power, OfDensityDiffusionIsWhatPressureLosesByIt) {
  TwoParticles two;
  auto& p = two.setting.parameters;
  p.density_diffusion = DensityDiffusion{0.1, DiffusionGradient::none};
  p.stiffness_exponent = 1;
  two.setting.scene.gravity = Vec(-10, 0);  // rho_i = 1000 exp(g depth/c_0^2)
  p.hydrostatic_start = HydrostaticStart{1.0};
  WeaklyCompressible solver = two.setting.solver();
  solver.advance(1e-12);
  const auto& f = solver.particles();
  double expected = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t j = 1 - i;
    const double psi_x = 2 * (f.rho[i] - f.rho[j]), slope = two.gradient().norm() * 0.05 / (0.05 * 0.05);
    const double D_i = -0.1 * two.h() * 20 * f.m[j] / f.rho[j] * psi_x * slope;
    expected -= f.m[i] * 400 * (f.rho[i] - 1000) / (f.rho[i] * f.rho[i]) * D_i;
  }
  EXPECT_NEAR(solver.powers().front().value, expected, 1e-7 * expected);
  EXPECT_GT(expected, 0);
}

TEST(Power, OfPressureIsThatOfUnlikeDensities) {
  TwoParticles two;
  two.setting.parameters.stiffness_exponent = 1;
  two.setting.scene.gravity = Vec(-1000, 0);
  two.setting.parameters.hydrostatic_start = HydrostaticStart{1.0};
  WeaklyCompressible solver = two.setting.solver();
  solver.advance(1e-12);
  const auto& f = solver.particles();
  const auto p_rho = [&](std::size_t i) { return 400 * (f.rho[i] - 1000) / f.rho[i]; };
  const Vec v_01 = at(f.v, 0) - at(f.v, 1), gradient = grad_W(at(f.x, 0), at(f.x, 1), two.h());
  const double expected =
      -f.m[0] * f.m[1] * (1 / f.rho[1] - 1 / f.rho[0]) * (p_rho(0) - p_rho(1)) * v_01.dot(gradient);
  EXPECT_GT(std::abs(f.rho[0] / f.rho[1] - 1), 0.05);
  EXPECT_NEAR(solver.powers().back().value, expected, 1e-7 * std::abs(expected));
}

TEST(EnergyBalance, IsIntegratedByTheTrapezoidalRule) {
  EnergyBalance balance({{"viscosity", Taken::dissipated, 0}, {"surface_tension", Taken::stored, 0}});
  balance.add(1.0, {{"viscosity", Taken::dissipated, 2}, {"surface_tension", Taken::stored, -1}});
  balance.add(3.0, {{"viscosity", Taken::dissipated, 6}, {"surface_tension", Taken::stored, 0}});
  EXPECT_DOUBLE_EQ(balance.taken(Taken::dissipated, 3), 2 + 8);
  EXPECT_DOUBLE_EQ(balance.taken(Taken::stored, 3), -1 - 1);
  std::map<std::string, double> row;
  for (const auto& seen : balance.observe(-7, 3)) row[seen.name] = seen.value;
  EXPECT_DOUBLE_EQ(row.at("dissipated_energy"), 7 + 2);
  EXPECT_DOUBLE_EQ(row.at("dissipated_by_viscosity"), 10);
  EXPECT_DOUBLE_EQ(row.at("stored_by_surface_tension"), -2);
  EXPECT_DOUBLE_EQ(row.at("energy_remainder"), -7 - 2 + 10);
  EXPECT_DOUBLE_EQ(balance.taken(Taken::dissipated, 3.5), 10 + 6 * 0.5) << "at the last rate";
}

TEST(EnergyBalanceRun, ClosesInEmptySpace) {
  Setting setting = colliding_drops();
  setting.parameters.integrator = Integrator::symplectic;
  WeaklyCompressible solver = setting.solver();
  const auto row = after(solver, 0.1, 0.1);
  for (const char* term : {"density_diffusion", "artificial_viscosity", "viscosity"})
    EXPECT_GT(row.at(std::string("dissipated_by_") + term), 5) << term;
  EXPECT_LT(std::abs(row.at("energy_remainder")), 1e-3 * row.at("dissipated_energy"));
}

TEST(EnergyBalance, ClosesWithWhatThePistonDoes) {
  Setting setting = collapsing_column();
  setting.parameters.integrator = Integrator::symplectic;
  setting.scene.walls[1].motion = Motion{{{0.0, 0.0, 0.0}, {0.1, 0.8, 0.0}, {0.2, 0.2, 0.0}}};
  setting.parameters.regions.front().box.max = Vec(1.0, 0.4);
  setting.parameters.hydrostatic_start = HydrostaticStart{0.4};
  WeaklyCompressible solver = setting.solver();
  const auto row = after(solver, 0.15);
  EXPECT_GT(row.at("work_from_left"), 5);
  const double changed = row.at("kinetic_energy") + row.at("potential_energy") + row.at("elastic_energy") -
                         columns(setting.solver()).at("potential_energy") -
                         columns(setting.solver()).at("elastic_energy");
  EXPECT_NEAR(row.at("dissipated_energy"), row.at("work_from_left") - changed, 1e-9);
  EXPECT_LT(std::abs(row.at("energy_remainder")), 0.05 * row.at("work_from_left"));
}

TEST(Work, OfTheInterfaceIsThatOfTheLoadItSends) {
  WeaklyCompressible solver = tank_with_a_plate().solver();
  const Interface interface = plate();
  solver.attach(interface);
  const Vec v(0.2, 0.1);
  const double dt = 0.4 * solver.time_step_limit();
  double work = 0;
  for (int n = 0; n < 10; ++n) {
    solver.begin_window(moved(interface, v, solver.time()), 2 * dt);
    solver.advance(dt);
    solver.advance(dt);
    const InterfaceLoad load = solver.take_load();
    for (std::size_t k = 0; k < interface.size(); ++k)
      work -= 2 * dt * v.dot(Vec(load.force[dim * k], load.force[dim * k + 1]));
  }
  const auto row = columns(solver);
  EXPECT_GT(std::abs(work), 0);
  EXPECT_EQ(row.count("dissipated_by_walls"), 1u);
  EXPECT_NEAR(row.at("work_from_interface"), work, 1e-10 * std::abs(work));
}

TEST(PotentialEnergy, GoesOnWhereSpaceRepeatsItself) {
  Setting setting = empty_space();
  setting.scene.domain = {Vec(0, 0), Vec(0.8, 0.8)};
  setting.scene.periodic = Periodic::xy;
  setting.scene.gravity = Vec(3, 0);
  setting.parameters.regions = {{"all", {Vec(0, 0), Vec(0.8, 0.8)}, Vec(4, 0)}};
  WeaklyCompressible solver = setting.solver();
  const double start = solver.potential_energy();
  run_until(solver, 0.5);
  const double way = 4 * 0.5 + 0.5 * 3 * 0.25;
  EXPECT_NEAR(solver.potential_energy() - start, -640 * 3 * way, 1e-6 * 640 * 3 * way);
  EXPECT_NEAR(columns(solver).at("dissipated_energy"), 0, 1e-6);
}

TEST(PotentialEnergy, HoldsThatOfACentralForce) {
  Setting setting = empty_space();
  setting.parameters.central_force = CentralForce{.rate = 2, .centre = Vec(1, 0)};
  setting.parameters.regions = {{"one", {Vec(0, 0), Vec(0.05, 0.05)}, Vec::Zero()}};
  WeaklyCompressible solver = setting.solver();
  EXPECT_NEAR(solver.potential_energy(), 2.5 * 0.5 * 4 * (Vec(0.025, 0.025) - Vec(1, 0)).squaredNorm(),
              1e-12);
  run_until(solver, 0.4);
  EXPECT_NEAR(columns(solver).at("dissipated_energy"), 0, 1e-4);
}

}  // namespace
}  // namespace toryu::fluid
