// Space that repeats itself.
#include "common/scene/period.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

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

}  // namespace
}  // namespace toryu::fluid
