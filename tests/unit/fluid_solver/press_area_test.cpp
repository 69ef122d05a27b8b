// The area over which a medium meets a wall that is pressed: what corners take of it, by sums over a lattice
// and about an axis, and the pressure at which it is held by then.
#include "fluid_solver/press_area.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error/failure.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

/// A weightless medium of 0.5 m by 0.5 m, `rows` across, in a closed tank whose lid presses with 1 kN.
Setting tank(int rows, KernelForm kernel, double h_over_d0) {
  const double d_0 = 0.5 / rows, thick = 6 * d_0;
  Setting s = empty_space();
  s.parameters.spacing = d_0;
  s.parameters.kernel = kernel;
  s.parameters.smoothing_ratio = h_over_d0;
  s.parameters.artificial_viscosity = ArtificialViscosity{1.0, 0.0};
  s.parameters.wall_model.slip = WallSlip::free_slip;
  s.parameters.background_pressure = BackgroundPressure{2000};
  s.parameters.enclosed_medium.emplace();
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(0.5, 0.5)}, Vec::Zero()}};
  s.scene.walls = {
      {"floor", {Vec(-thick, -thick), Vec(0.5 + thick, 0)}, {}},
      {"left", {Vec(-thick, 0), Vec(0, 1.2)}, {}},
      {"right", {Vec(0.5, 0), Vec(0.5 + thick, 1.2)}, {}},
      {"lid",
       {Vec(0, 0.5), Vec(0.5, 0.5 + thick)},
       {},
       Press{
           .pressure = {}, .force = {{0, 1000}}, .direction = Direction::minus_y, .travel = Vec(-0.1, 0.1)}}};
  return s;
}

const Boundary& lid_of(const FluidModel& model) {
  for (const auto& boundary : model.boundaries())
    if (boundary.name == "lid") return boundary;
  throw std::out_of_range("lid");
}

Kernel kernel_of(const Parameters& p) {
  if (p.kernel == KernelForm::wendland_c2) return WendlandC2(p.h());
  return CubicSpline(p.h());
}

/// Over the spacing: what a corner takes of the area, as the sum over all pairs of a lattice across it.
double taken_by_a_corner(KernelForm form, double h) {
  const auto sum = [&](const auto& W) {
    double taken = 0;
    for (int m = 1; m < 20; ++m)
      for (int n = 1; n < 20; ++n) {
        const double r = std::hypot(m, n), e = 1e-5;
        const double slope = (W.value(r + e) - W.value(r - e)) / (2 * e);
        taken += 2 * m * n * -slope * m / r;
      }
    return taken;
  };
  return form == KernelForm::wendland_c2 ? sum(Kernel(WendlandC2(h))) : sum(Kernel(CubicSpline(h)));
}

TEST(PressArea, IsShortByWhatTheCornersTake) {
  for (const auto& [form, h, taken, flat] : {std::tuple{KernelForm::wendland_c2, 2.0, 0.392, 0.9992},
                                             {KernelForm::cubic_spline, 1.25, 0.228, 1.0010},
                                             {KernelForm::cubic_spline, 1.5, 0.306, 1.0067}}) {
    EXPECT_NEAR(taken_by_a_corner(form, h), taken, 5e-4);
    for (const int rows : {10, 20}) {
      const Setting s = tank(rows, form, h);
      WeaklyCompressible model = s.solver();
      model.advance(1e-9);
      const double met = met_area(lid_of(model), model.particles(), kernel_of(s.parameters));
      EXPECT_NEAR(met, -lid_of(model).force_on_fluid.force()[1] / 2000, 1e-9) << "by the sums of the run";
      EXPECT_NEAR(met / 0.5, flat - 2 * taken_by_a_corner(form, h) / rows, 2e-4) << h << " " << rows;
    }
  }
  // and of a kernel that sees many rows the mean distance over pi
  EXPECT_NEAR(taken_by_a_corner(KernelForm::wendland_c2, 9) / 9, 2 / (3 * M_PI), 0.001);
  EXPECT_NEAR(taken_by_a_corner(KernelForm::cubic_spline, 9) / 9, 5 / (7 * M_PI), 0.001);
}

TEST(PressArea, IsOfAWholeDiscAboutAnAxis) {
  Setting s = tank(10, KernelForm::wendland_c2, 2);
  s.scene.geometry = Geometry::axisymmetric;
  s.parameters.artificial_viscosity.reset();
  s.parameters.laminar_viscosity = LaminarViscosity{10};
  const double thick = 6 * 0.05;
  s.scene.walls = {
      {"end", {Vec(0.5, 0), Vec(0.5 + thick, 0.5)}, {}},
      {"bore", {Vec(-1, 0.5), Vec(0.5 + thick, 0.5 + thick)}, {}},
      {"lid",
       {Vec(-thick, 0), Vec(0, 0.5)},
       {},
       Press{
           .pressure = {{0, 2000}}, .force = {}, .direction = Direction::plus_x, .travel = Vec(-0.1, 0.1)}}};
  WeaklyCompressible model = s.solver();
  model.advance(1e-9);
  const double met =
      met_area(lid_of(model), model.particles(), kernel_of(s.parameters), Geometry::axisymmetric);
  EXPECT_NEAR(met, lid_of(model).force_on_fluid.force()[0] / 2000, 1e-9 * met) << "by the sums of the run";
  const double taken = taken_by_a_corner(KernelForm::wendland_c2, 2) * 0.05;
  EXPECT_NEAR(met / (M_PI * 0.25), 0.9992 - 2 * taken / 0.5, 0.01);
}

TEST(PressArea, NeedsTheMediumBeforeTheFaceAlone) {
  const Setting s = tank(10, KernelForm::wendland_c2, 2);
  const WeaklyCompressible model = s.solver();
  for (const double met : {0.0, 0.2, -0.5, 0.8})  // on both sides or gone, leaving, behind, around
    EXPECT_THROW(require_medium_before_face(lid_of(model), met), PhysicsFailure) << met;
  EXPECT_NO_THROW(require_medium_before_face(lid_of(model), 0.45));
}

// A force of 1 kN on 0.5 m holds the medium at 2 kPa, all of which it knows.
TEST(PressedTankRun, HoldsItsMediumAtTheForceOverTheFace) {
  for (const int rows : {10, 20}) {
    const Setting s = tank(rows, KernelForm::wendland_c2, 2);
    WeaklyCompressible model = s.solver();
    double p = 0;
    int samples = 0;
    for (int n = 1; n <= 30; ++n) {
      run_until(model, 0.01 * n);
      if (n <= 10) continue;
      const Particles& f = model.particles();
      for (std::size_t i = 0; i < f.count; ++i) p += f.p[i], ++samples;
    }
    RecordProperty("over_force_" + std::to_string(rows), std::to_string(p / samples / 2000));
    EXPECT_NEAR(p / samples / 2000 - 1, 0, 0.003) << rows;
  }
}

}  // namespace
}  // namespace toryu::fluid
