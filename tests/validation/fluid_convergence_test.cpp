// What falls with the step or the spacing, on scenes of the unit tests: too long for them under the
// sanitizers.
#include <gtest/gtest.h>

#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

TEST(EnergyBalance, RemainsOpenByTheSquareOfTheStep) {
  for (const double spacing : {0.05, 0.025}) {
    Setting setting = colliding_drops();
    setting.parameters.spacing = spacing;
    setting.parameters.integrator = Integrator::symplectic;
    std::vector<double> left;
    for (const double share : {0.4, 0.2}) {
      WeaklyCompressible solver = setting.solver();
      const auto row = after(solver, 0.1, share);
      left.push_back(std::abs(row.at("energy_remainder")) / row.at("dissipated_energy"));
      RecordProperty("of_" + std::to_string(spacing) + "_at_" + std::to_string(share),
                     std::to_string(left.back()));
    }
    EXPECT_LT(left[0], 0.01) << spacing;
    EXPECT_LT(left[1], 0.35 * left[0]) << spacing;
  }
}

/// Largest |energy_remainder| to `end` [s], over the energy dissipated by then.
double largest_remainder(WeaklyCompressible solver, double end, double share) {
  double largest = 0;
  while (solver.time() < end - 1e-12) {
    const auto row = after(solver, std::min(solver.time() + end / 50, end), share);
    largest = std::max(largest, std::abs(row.at("energy_remainder")));
  }
  return largest / columns(solver).at("dissipated_energy");
}

TEST(EnergyBalance, OfADamBreakAndAWaveRemainsOpenByTheSquareOfTheStep) {
  const struct {
    const char* name;
    std::vector<std::string> settings;
    double end, largest;
  } cases[] = {{"dam_break", {"fluid.spacing=0.0057150"}, 0.06, 0.01},
               {"standing_wave", {"fluid.spacing=0.05"}, 0.4, 0.2}};
  for (const auto& [name, settings, end, largest] : cases) {
    std::vector<double> left;
    for (const double share : {1.0, 0.5, 0.25})
      left.push_back(largest_remainder(FluidCase(name, settings).solver(), end, share));
    const double slope = std::log2(left[0] / left[2]) / 2;
    RecordProperty(name, std::to_string(left[0]) + ", slope " + std::to_string(slope));
    EXPECT_LT(left[0], largest) << name;
    EXPECT_GT(slope, 1.7) << name;
  }
}

/// A square tank full of a thick fluid, which turns at 10 rad/s about a point off its middle.
Setting spun_tank(double spacing) {
  Setting s = empty_space();
  s.parameters.spacing = spacing;
  s.parameters.sound_speed = 60;
  s.parameters.laminar_viscosity = LaminarViscosity{500};
  s.parameters.regions = {{"fluid", {Vec(0, 0), Vec(0.4, 0.4)}, Vec::Zero()}};
  const double d = 4 * spacing;
  s.scene.walls = {{"bottom", {Vec(-d, -d), Vec(0.4 + d, 0)}, {}},
                   {"top", {Vec(-d, 0.4), Vec(0.4 + d, 0.4 + d)}, {}},
                   {"left", {Vec(-d, 0), Vec(0, 0.4)}, {}},
                   {"right", {Vec(0.4, 0), Vec(0.4 + d, 0.4)}, {}}};
  s.scene.motions = {{"tank", turning_at(10, Vec(0.1, 0.2))}};
  for (Wall& wall : s.scene.walls) wall.motion = s.scene.motions[0].motion, wall.moves_with = "tank";
  return s;
}

struct ErrorsOfRigidTurn {
  double speed = 0;     ///< largest, of the speed at the far corner
  double energy = 0;    ///< of that of the turn
  double pressure = 0;  ///< of the slope of p over r^2, rho w^2/2
  double moment = 0;    ///< of the walls, which is none, over that of mu grad v alone
};

ErrorsOfRigidTurn errors_of_rigid_turn(double spacing) {
  WeaklyCompressible solver = spun_tank(spacing).solver();
  EXPECT_EQ(solver.boundaries().size(), 1u) << "walls that move alike are one";
  run_until(solver, 0.2);
  const Particles& f = solver.particles();
  const Vec about(0.1, 0.2);
  ErrorsOfRigidTurn errors;
  double energy = 0, energy_of_turning = 0, n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < f.count; ++i) {
    const Vec r = at(f.x, i) - about, v = 10 * Vec(-r[1], r[0]);
    errors.speed = std::max(errors.speed, (at(f.v, i) - v).norm() / 3.6);
    energy += 0.5 * f.m[i] * at(f.v, i).squaredNorm();
    energy_of_turning += 0.5 * f.m[i] * v.squaredNorm();
    const double r2 = r.squaredNorm(), p = f.p[i];
    n += 1, x += r2, y += p, xx += r2 * r2, xy += r2 * p;
  }
  errors.energy = std::abs(energy / energy_of_turning - 1);
  errors.pressure = std::abs((n * xy - x * y) / (n * xx - x * x) / (0.5 * 1000 * 100) - 1);
  const auto row = columns(solver);
  errors.moment = std::abs(row.at("moment_from_tank")) / (2 * 500 * 10 * 0.16);
  EXPECT_NEAR(row.at("power_from_tank"), 10 * row.at("moment_from_tank"), 1e-9 * 500 * 100);
  return errors;
}

TEST(TurningTank, OfThickFluidComesToTurnRigidly) {
  const ErrorsOfRigidTurn coarse = errors_of_rigid_turn(0.04), fine = errors_of_rigid_turn(0.02);
  EXPECT_LT(fine.speed, 0.01);
  EXPECT_LT(fine.energy, 1e-3);
  EXPECT_LT(fine.pressure, 0.01);
  EXPECT_LT(fine.moment, 0.1);
  EXPECT_LT(fine.moment, 0.6 * coarse.moment) << "of first order, by the depth of the walls' particles";
}

}  // namespace
}  // namespace toryu::fluid
