// Space that repeats itself.
#include "common/scene/period.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <sstream>

#include "fluid_solver/wall_rows.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/plate.hpp"

namespace toryu::fluid {
namespace period_test {

Scene room(Periodic periodic, const Vec& max) {
  Scene scene;
  scene.domain = {Vec(-1, 0), max};
  scene.periodic = periodic;
  return scene;
}

TEST(Period, MovesByWholeLengths) {
  const Period both(room(Periodic::xy, Vec(1, 3)), 0.1, 0.5), x(room(Periodic::x, Vec(1, 3)), 0.1, 0.5);
  EXPECT_EQ(both.shifts().size(), 9u);
  EXPECT_EQ(x.shifts(), (std::vector<Vec>{{0, 0}, {-2, 0}, {2, 0}}));
  EXPECT_EQ(x.back_into_domain(Vec(1.25, 4)), Vec(-2, 0));
  EXPECT_EQ(both.back_into_domain(Vec(-1.25, 4)), Vec(2, -3));
  EXPECT_EQ(both.back_into_domain(Vec(0.5, 1)), Vec(0, 0));
  EXPECT_LT((both.shortest(Vec(1.75, -2)) - Vec(-0.25, 1)).norm(), 1e-15);
  EXPECT_FALSE(Period(room(Periodic::none, Vec(1, 3)), 0.7, 9).any());
}

std::string fault(const Scene& scene, double spacing, double reach) {
  try {
    Period(scene, spacing, reach);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Period, RefusesAGapAtTheSeamAndAKernelThatMeetsItself) {
  EXPECT_NE(fault(room(Periodic::x, Vec(1, 3)), 0.3, 0.5).find("is 6.66667 spacings"), std::string::npos);
  EXPECT_NE(fault(room(Periodic::xy, Vec(1, 0.9)), 0.1, 0.5).find("shorter than 1 m"), std::string::npos);
  EXPECT_EQ(fault(room(Periodic::x, Vec(1, 0.9)), 0.1, 0.5), "");
}

struct Flow {
  std::vector<Vec> x, v;
};

/// A flow in a box that repeats itself, all of it moved by `move`: the same flow with its seam elsewhere.
Flow after_some_steps(const Vec& move) {
  Setting s = empty_space();
  s.scene.domain = {Vec(0, 0), Vec(1, 1)};
  s.scene.periodic = Periodic::xy;
  s.parameters.laminar_viscosity = LaminarViscosity{1.0};
  s.parameters.regions = {{"all", s.scene.domain, Vec(3, 0.5)}};
  s.parameters.initial_flow = InitialFlow{FlowProfile::taylor_green, 1.0, 1.0, 0, move};
  WeaklyCompressible solver = s.solver();
  const Vec before = solver.momentum();
  for (int n = 0; n < 100; ++n) solver.advance(5e-4);  // 0.15 to the right: across the seam
  EXPECT_GT(solver.list_builds(), 3);
  EXPECT_LT((solver.momentum() - before).norm(), 1e-13 * before.norm());
  return {positions(solver), by_id(solver, solver.particles().v)};
}

TEST(PeriodicFlow, DoesNotKnowWhereTheSeamIs) {
  const Flow here = after_some_steps(Vec(0, 0)), there = after_some_steps(Vec(0.25, 0.4));
  const int n = 20, columns = 5, rows = 8;  // by which the flow is moved
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const auto k = static_cast<std::size_t>(row * n + column);
      const auto moved = static_cast<std::size_t>((row + rows) % n * n + (column + columns) % n);
      EXPECT_LT((there.v[moved] - here.v[k]).norm(), 1e-11) << k;
    }
}

TEST(PeriodicFlow, LetsAWallGoRoundAndRound) {
  Setting s = empty_space();
  s.scene.domain = {Vec(0, -0.2), Vec(0.5, 0.6)};
  s.scene.periodic = Periodic::x;
  s.parameters.laminar_viscosity = LaminarViscosity{200.0};  // the flow is steady at once
  s.scene.walls = {{"floor", {Vec(0, -0.2), Vec(0.5, 0)}, {}},
                   {"belt", {Vec(0, 0.4), Vec(0.5, 0.6)}, Motion{{{0.0, 2.0, 0.0}}}}};
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(0.5, 0.4)}, Vec(0, 0)}};
  WeaklyCompressible solver = s.solver();
  run_until(solver, 0.6);  // the belt has gone round twice and a bit
  const auto& f = solver.particles();
  for (std::size_t k = 0; k < f.count; ++k) EXPECT_NEAR(f.v[0][k], 5 * f.x[1][k], 0.1);
  for (const auto& wall : solver.boundaries())
    for (std::size_t k = 0; k < wall.count; ++k) EXPECT_LT(std::abs(wall.x[0][k] - 0.25), 0.3);
}

constexpr double d_0 = 1.0 / 16;  // a binary fraction: a scene that is moved is the same to the last bit

/// A medium in a box of 16 spacings that repeats itself, without a block of 4 spacings whose corner is at
/// `corner`.
Setting medium_about_a_block(const Vec& corner) {
  Setting s = empty_space();
  s.scene.domain = {Vec(0, 0), Vec(1, 1)};
  s.scene.periodic = Periodic::xy;
  s.scene.gravity = Vec(4, 1);
  s.parameters.spacing = d_0;
  s.parameters.laminar_viscosity = LaminarViscosity{20.0};
  s.parameters.background_pressure = BackgroundPressure{2e3};
  s.parameters.regions = {{"all", s.scene.domain, Vec(1, 0.5)}};
  s.parameters.holes = {{Box{corner, corner + Vec::Constant(4 * d_0)}, "block", {}}};
  repeat_holes(Period(s.scene), s.parameters);
  return s;
}

/// The block as a solid registers it, with faces on its sides.
Interface block(const Vec& corner) {
  Interface block;
  block.spacing = d_0;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const Vec x = corner + d_0 * Vec(column + 0.5, row + 0.5);
      const auto side = [](int n) { return n == 0 ? -d_0 : n == 3 ? d_0 : 0.0; };
      block.id.push_back(static_cast<std::uint32_t>(block.id.size()));
      block.position.insert(block.position.end(), {x[0], x[1]});
      block.volume.push_back(d_0 * d_0);
      block.area_vector.insert(block.area_vector.end(), {side(column), side(row)});
    }
  return block;
}

/// Loads of `windows` windows in which the block is carried along.
std::vector<double> loads(WeaklyCompressible& solver, const Interface& block, int windows) {
  std::vector<double> all;
  for (int n = 0; n < windows; ++n) {
    const double dt = 0.001;
    solver.begin_window(moved(block, Vec(6, 4), solver.time() + dt), dt);
    solver.advance(dt);
    const InterfaceLoad load = solver.take_load();
    all.insert(all.end(), load.force.begin(), load.force.end());
    all.insert(all.end(), load.friction_force.begin(), load.friction_force.end());
  }
  return all;
}

/// Largest difference over the largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0, apart = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    most = std::max(most, std::abs(a[k]));
    apart = std::max(apart, std::abs(a[k] - b[k]));
  }
  return apart / most;
}

TEST(PeriodicInterface, DoesNotKnowWhereTheSeamIs) {
  // What lies elsewhere is stored in another order. Sums differ in their last bits, 1e-16 of the pressure,
  // and the flow makes of that a thousand times as much in a hundred steps.
  const auto run = [](const Vec& corner) {
    Setting s = medium_about_a_block(corner);
    s.parameters.friction = Friction{0.3, FrictionForm::normalised, 0.5};
    WeaklyCompressible solver = s.solver();
    solver.attach(block(corner));
    auto found = loads(solver, block(corner), 100);  // 0.6 m to the right and 0.4 m up
    const Boundary& interface = solver.boundaries().back();
    for (std::size_t k = 0; k < interface.count; ++k)
      EXPECT_TRUE((Box{Vec(-0.1, -0.1), Vec(1.1, 1.1)}.contains(at(interface.x, k)))) << "wrapped";
    return found;
  };
  const auto within = run(6 * Vec(d_0, d_0)), across = run(14 * Vec(d_0, d_0)),
             before = run(-2 * Vec(d_0, d_0));
  EXPECT_LT(difference(within, across), 1e-11);
  EXPECT_LT(difference(within, before), 1e-11);
}

TEST(PeriodicInterface, GoesOnFromACheckpointToTheBit) {
  const Vec corner = 10 * Vec(d_0, d_0);
  const Setting s = medium_about_a_block(corner);
  WeaklyCompressible solver = s.solver();
  solver.attach(block(corner));
  loads(solver, block(corner), 60);
  std::stringstream checkpoint;
  solver.write_state(checkpoint);
  WeaklyCompressible other = s.solver();
  other.attach(block(corner));
  other.read_state(checkpoint);
  EXPECT_EQ(loads(other, block(corner), 60), loads(solver, block(corner), 60));
}

TEST(PeriodicInterface, TakesThePlaceOfAWallBeyondTheSeam) {
  const Vec corner = 14 * Vec(d_0, d_0);
  Setting s = medium_about_a_block(corner);
  s.scene.walls = {{"core", {Vec(0, 0), Vec(d_0, 2 * d_0)}, {}}};
  WeaklyCompressible solver = s.solver();
  ASSERT_EQ(solver.boundaries().size(), 1u);
  solver.attach(block(corner));
  ASSERT_EQ(solver.boundaries().size(), 1u) << "the solid covers it";
  EXPECT_TRUE(solver.boundaries()[0].is_interface());
}

TEST(PeriodicWall, DoesNotKnowWhereTheSeamIs) {
  const auto run = [](const Vec& corner) {
    Setting s = medium_about_a_block(corner);
    s.parameters.friction = Friction{0.3, FrictionForm::normalised, 0.5};
    s.parameters.wall_model.extrapolation = WallExtrapolation::fit;
    s.scene.walls = {{.name = "piece",
                      .box = s.parameters.holes.front(),
                      .motion = Motion{{{0, 6, 4}}},
                      .work_piece = true}};
    WeaklyCompressible solver = s.solver();
    std::vector<double> found;
    for (int n = 0; n < 100; ++n) {
      solver.advance(0.001);
      const auto row = columns(solver);
      for (const char* name : {"force_from_piece_x", "force_from_piece_y", "friction_from_piece_x"})
        found.push_back(row.at(name));
    }
    return found;
  };
  EXPECT_LT(difference(run(6 * Vec(d_0, d_0)), run(14 * Vec(d_0, d_0))), 1e-11);
}

TEST(Period, FindsTheImagesOfHoles) {
  const Period period(room(Periodic::x, Vec(1, 3)));  // from -1 to 1
  const std::vector<Box> body{{Vec(-1, 0), Vec(1, 3)}};
  EXPECT_TRUE(images_in(body, {{Vec(-1, 0), Vec(1, 1)}, {Vec(0, -5), Vec(0.5, 0)}}, period, 1e-6).empty());
  const auto found = images_in(body, {{Vec(0.5, 1), Vec(1.5, 2)}, {Vec(-1.25, 0), Vec(0, 1)}}, period, 1e-6);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].min, Vec(-1.5, 1));
  EXPECT_EQ(found[1].max, Vec(2, 1));
  EXPECT_TRUE(images_in(body, {{Vec(0.5, 1), Vec(1.5, 2)}}, Period(), 1e-6).empty());
}

}  // namespace period_test
}  // namespace toryu::fluid
