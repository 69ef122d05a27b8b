// Particle shifting, who is inside, and tensile control.
#include "fluid_solver/weakly_compressible/shifting.hpp"

#include <gtest/gtest.h>

#include "fluid_solver/free_surface.hpp"
#include "fluid_solver/terms/tensile_control.hpp"
#include "fluid_solver/weakly_compressible/polymer.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace shifting_test {

constexpr double d_0 = 0.05;

/// A disordered block.
Setting block() {
  Setting s = empty_space();
  s.parameters.kernel = KernelForm::wendland_c2;
  s.parameters.start_disorder = 0.2;
  s.parameters.regions = {{"block", {Vec(0, 0), Vec(0.8, 0.7)}, Vec(0, 0)}};
  return s;
}

/// Its particles in the order of their neighbour lists, volumes included.
struct Sorted {
  Particles fluid;
  Neighbours lists;
};
Sorted sorted(const WendlandC2& kernel) {
  const WeaklyCompressible solver = block().solver();
  Sorted s{solver.particles(), {kernel.support(), 0.1 * kernel.support(), 0.1, {Vec::Zero()}}};
  std::vector<Boundary> none;
  s.lists.build(s.fluid, none, 0);
  for (std::size_t i = 0; i < s.fluid.count; ++i) s.fluid.V[i] = d_0 * d_0;
  return s;
}

TEST(FreeSurface, IsInReachOfTheOuterRowsAlone) {
  const WendlandC2 kernel(1.5 * d_0);
  Sorted s = sorted(kernel);
  FreeSurface().find_off_surface(s.fluid, s.lists.of_fluid(), {}, kernel);
  int inside = 0;
  for (std::size_t i = 0; i < s.fluid.count; ++i) {
    const Vec x = at(s.fluid.x, i);
    const double depth = std::min(std::min(x[0], 0.8 - x[0]), std::min(x[1], 0.7 - x[1]));
    const bool near = depth<kernel.support() - 0.5 * d_0, far = depth> kernel.support() + 2 * d_0;
    if (near || far) {
      EXPECT_EQ(s.fluid.off_surface[i], far ? 1 : 0) << x.transpose();
    }
    inside += s.fluid.off_surface[i] == 1;
  }
  EXPECT_GT(inside, 10);
}

TEST(Shifting, IsTheSumOfItsFormulaAndLeavesLinearFieldsInPlace) {
  const WendlandC2 kernel(1.5 * d_0);
  Sorted s = sorted(kernel);
  const auto v = [](const Vec& x) { return Vec(2 * x[0] - x[1] + 1, 3 * x[1] + 0.5 * x[0]); };
  const auto rho = [](const Vec& x) { return 1000 + 30 * x[0] - 20 * x[1]; };
  for (std::size_t i = 0; i < s.fluid.count; ++i) {
    set(s.fluid.v, i, v(at(s.fluid.x, i)));
    s.fluid.rho[i] = rho(at(s.fluid.x, i));
  }
  allocate_polymer(Viscoelasticity{{{1, 1, 0}, {2, 1, 0}}}, s.fluid);
  const auto psi = [](const Vec& x, std::size_t n) { return static_cast<double>(n) - 2 * x[0] + 3 * x[1]; };
  for_each_log_conformation(s.fluid, [&](Field& field, const Field&, std::size_t n) {
    for (std::size_t i = 0; i < s.fluid.count; ++i) field[i] = psi(at(s.fluid.x, i), n);
  });
  s.fluid.off_surface.assign(padded(s.fluid.count), 1.0);
  s.fluid.off_surface[7] = 0;
  const Particles before = s.fluid;
  const double speed = 0.3, dt = 1e-3, A = 1.7;
  Shifting(ParticleShifting{A}, d_0, kernel).shift(s.fluid, s.lists.of_fluid(), {}, speed, dt);
  EXPECT_EQ(at(s.fluid.x, 7), at(before.x, 7));
  int limited = 0;
  for (std::size_t i = 0; i < s.fluid.count; ++i) {
    if (i == 7) continue;
    const Vec x_i = at(before.x, i);
    Vec sum = Vec::Zero();
    for (std::size_t j = 0; j < s.fluid.count; ++j) {
      const Vec x_ij = x_i - at(before.x, j);
      const double r = x_ij.norm();
      if (j == i || r >= kernel.support()) continue;
      const double share = kernel.value(r) / kernel.value(d_0);
      sum += d_0 * d_0 * (1 + 0.2 * std::pow(share, 4)) * kernel.gradient_over_r(r, 1 / r) * x_ij;
    }
    Vec dx = -A * kernel.h() * speed * dt * sum;
    if (dx.norm() > 0.5 * speed * dt) {
      dx *= 0.5 * speed * dt / dx.norm();
      ++limited;
    }
    const Vec x = at(s.fluid.x, i);
    EXPECT_LT((x - x_i - dx).norm(), 1e-14);
    EXPECT_LT((at(s.fluid.v, i) - v(x)).norm(), 1e-13);
    EXPECT_NEAR(s.fluid.rho[i], rho(x), 1e-10);
    EXPECT_NEAR(s.fluid.log_conformation[0].xx[i], psi(x, 0), 1e-13);
    EXPECT_NEAR(s.fluid.log_conformation[1].xy[i], psi(x, 5), 1e-13);
  }
  EXPECT_GT(limited, 0);
  EXPECT_LT(limited, static_cast<int>(s.fluid.count) / 2);
}

TEST(TensileControl, TurnsTheSignOfASuctionInsideTheFluidAlone) {
  EXPECT_EQ(without_tension(-3.0, 1.0)[0], 3.0);
  EXPECT_EQ(without_tension(-3.0, 0.0)[0], -3.0);
  EXPECT_EQ(without_tension(2.0, 1.0)[0], 2.0);
}

/// Acceleration of the fluid of a block under one pressure, disordered, by the number at the start.
std::vector<Vec> acceleration(double p, bool controlled) {
  Setting s = block();
  s.parameters.density_diffusion.reset();
  s.parameters.artificial_viscosity.reset();
  s.parameters.regions.front().box.max = Vec(1.2, 1.2);
  if (controlled) s.parameters.tensile_control = TensileControl{};
  s.parameters.background_pressure = BackgroundPressure{p};  // a suction, for once
  WeaklyCompressible solver = s.solver();
  solver.advance(1e-9);
  return by_id(solver, solver.particles().a);
}

TEST(TensileControl, TakesTheForceOffAUniformSuction) {
  // symmetric, disordered particles under one pressure p feel 2 p sum V gradW/rho; as a difference nothing
  const auto pulled = acceleration(-500, false), calm = acceleration(-500, true);
  const auto pushed = acceleration(500, true), pushed_plain = acceleration(500, false);
  EXPECT_EQ(largest_difference(pushed, pushed_plain), 0);
  const std::size_t middle = 12 * 24 + 12;
  EXPECT_GT(pulled[middle].norm(), 0.1);
  EXPECT_LT(calm[middle].norm(), 1e-6 * pulled[middle].norm());
}

/// Positions of a disordered block under suction after two steps, with a wall on its left; lists that reach a
/// `skin` farther than the kernel.
std::vector<Vec> beside_a_wall(double skin, bool controlled) {
  Setting s = block();
  s.parameters.neighbour_skin = skin;
  s.parameters.background_pressure = BackgroundPressure{-500};
  s.scene.walls = {{"wall", {Vec(-0.2, 0), Vec(0, 0.7)}, {}}};
  if (controlled) s.parameters.tensile_control = TensileControl{};
  WeaklyCompressible solver = s.solver();
  for (int n = 0; n < 2; ++n) solver.advance(1e-3);
  return positions(solver);
}

TEST(TensileControl, DoesNotDependOnTheNeighbourLists) {
  const auto tight = beside_a_wall(0.02, true), wide = beside_a_wall(0.5, true);
  EXPECT_LT(largest_difference(tight, wide), 1e-14);
  EXPECT_GT(largest_difference(tight, beside_a_wall(0.02, false)), 1e-6);
}

TEST(FreeSurface, IsNoBetterThanAWallForWhatKeepsOffBoth) {
  const WendlandC2 kernel(1.5 * d_0);
  Sorted s = sorted(kernel);
  s.fluid.off_surface.assign(padded(s.fluid.count), 1.0);
  s.fluid.off_surface[7] = 0;
  Boundary wall;
  wall.place({Vec(0, 0.35)}, {d_0 * d_0}, 1000, 0.1);
  std::vector<Boundary> walls{wall};
  s.lists.build(s.fluid, walls, 0);
  find_off_surface_and_walls(s.fluid, walls, kernel);
  for (std::size_t i = 0; i < s.fluid.count; ++i)
    EXPECT_EQ(s.fluid.off_surface_and_walls[i],
              i != 7 && (at(s.fluid.x, i) - Vec(0, 0.35)).norm() >= kernel.support());
}

TEST(Shifting, BesideAWallTheDensityFollowsTheParticles) {
  const WendlandC2 kernel(1.5 * d_0);
  Sorted s = sorted(kernel);
  s.fluid.off_surface.assign(padded(s.fluid.count), 1.0);
  std::vector<Vec> floor;  // three rows
  for (int row = 0; row < 3; ++row)
    for (int column = -5; column <= 20; ++column) floor.emplace_back(column * d_0, -(0.5 + row) * d_0);
  std::vector<Boundary> walls(1);
  walls[0].place(floor, std::vector<double>(floor.size(), d_0 * d_0), 1000, 0.3);
  walls[0].list_for_fluid.build(s.fluid.x, s.fluid.count, walls[0].x, walls[0].strips, kernel.support());
  for (std::size_t i = 0; i < s.fluid.count; ++i) s.fluid.rho[i] = 1000;
  const Particles before = s.fluid;
  Shifting(ParticleShifting{1.7}, d_0, kernel).shift(s.fluid, s.lists.of_fluid(), walls, 0.3, 1e-3);
  const auto moved = [&](std::size_t i) { return Vec(at(s.fluid.x, i) - at(before.x, i)); };
  int beside = 0;
  for (std::size_t i = 0; i < s.fluid.count; ++i) {
    const Vec x_i = at(before.x, i);
    double sum = 0, walls_near = 0;
    const auto add = [&](const Vec& x_j, const Vec& dx_j) {
      const Vec x_ij = x_i - x_j;
      const double r = x_ij.norm();
      if (r == 0 || r >= kernel.support()) return 0.0;
      sum += d_0 * d_0 * kernel.gradient_over_r(r, 1 / r) * x_ij.dot(moved(i) - dx_j);
      return 1.0;
    };
    for (std::size_t j = 0; j < s.fluid.count; ++j) add(at(before.x, j), moved(j));
    for (const Vec& x_w : floor) walls_near += add(x_w, Vec::Zero());
    beside += walls_near > 0;
    EXPECT_NEAR(s.fluid.rho[i], walls_near > 0 ? 1000 * (1 + sum) : 1000, 1e-8) << x_i.transpose();
  }
  EXPECT_GT(beside, 10);
}

}  // namespace shifting_test
}  // namespace toryu::fluid
