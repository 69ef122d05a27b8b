// Friction on work pieces (33), by pairs worked by hand, and what the solver makes of it.
#include "fluid_solver/weakly_compressible/friction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

constexpr double d_0 = 0.1, h = 1.2 * d_0, mu_A = 0.4, eps = 1e-3;
const CubicSpline kernel(h);

WorkPieceFriction friction(FrictionForm form, Geometry geometry) {
  return {{.coefficient = mu_A, .form = form, .regularisation_speed = eps}, d_0, 20, kernel, geometry};
}

struct SurfacePoint {
  Vec x, v, area_vector;
};

/// Forces on the work piece's particles and on all fluid.
struct Rubbed {
  std::vector<Vec> on_piece;
  Vec on_fluid;       ///< as the solver counts it
  Vec momentum_rate;  ///< of the fluid's particles, sum m a
};

/// Of particles that have their images beyond the axis, if there is one.
void mirror_all(Particles& fluid, Boundary& boundary) {
  for (VecField* field : {static_cast<VecField*>(&fluid.x), static_cast<VecField*>(&fluid.v),
                          static_cast<VecField*>(&boundary.x), static_cast<VecField*>(&boundary.v)})
    mirror(*field);
  mirror(fluid.p);
  mirror(fluid.V);
}

Rubbed rub(const std::vector<SurfacePoint>& piece, const std::vector<Point>& points, FrictionForm form,
           double p_offset = 0, Geometry geometry = Geometry::plane) {
  Particles fluid;
  fluid.count = points.size();
  const std::size_t room = room_of(fluid.count, geometry);
  for (auto* field : {&fluid.x, &fluid.v, &fluid.a}) resize(*field, room);
  for (auto* field : {&fluid.p, &fluid.rho, &fluid.V, &fluid.m}) field->resize(room, 0.0);
  Field x, y;
  for (const Point& point : points) x.push_back(point.x[0]), y.push_back(point.x[1]);
  StripOrder strips(0.3);
  const auto order = strips.sort(x, y, fluid.count);
  std::fill(fluid.rho.begin(), fluid.rho.end(), 1.0);
  for (std::size_t k = 0; k < fluid.count; ++k) {
    const Point& point = points[order[k]];
    set(fluid.x, k, point.x);
    set(fluid.v, k, point.v);
    fluid.p[k] = point.p;
    fluid.rho[k] = point.rho;
    fluid.m[k] = point.m;
    fluid.V[k] = point.m / point.rho;
    if (geometry == Geometry::axisymmetric) fluid.V[k] /= circumference(point.x[1]);
  }
  strips.index(fluid.x[0], fluid.count);

  Boundary boundary;
  std::vector<Vec> places;
  std::vector<Faces> faces;
  for (const auto& s : piece) places.push_back(s.x), faces.push_back(faces_of(s.area_vector));
  boundary.place(places, std::vector<double>(piece.size(), d_0 * d_0), 1000, 0.3, geometry);
  boundary.make_work_piece(faces);
  boundary.move_to([&](std::uint32_t k) { return Kinematics{piece[k].x, piece[k].v, Vec::Zero()}; });
  const Vec unshifted = Vec::Zero();
  const bool about_axis = geometry == Geometry::axisymmetric;
  if (about_axis) mirror_all(fluid, boundary);
  const auto build = [&](ClusterList& list, const VecField& targets, std::size_t target_count,
                         const VecField& sources, std::size_t source_count, const StripOrder& order_of) {
    list.build_with_images(targets, target_count, sources, order_of, 1.1 * kernel.support(),
                           std::span(&unshifted, 1), about_axis ? padded(source_count) : 0);
  };
  build(boundary.list_for_wall, boundary.x, boundary.count, fluid.x, fluid.count, strips);
  build(boundary.list_for_fluid, fluid.x, fluid.count, boundary.x, boundary.count, boundary.strips);

  const WorkPieceFriction term = friction(form, geometry);
  term.measure_contact(boundary, fluid);
  term.brake_fluid(fluid, p_offset, boundary);
  term.drag_work_piece(boundary, fluid, p_offset);
  Rubbed rubbed{std::vector<Vec>(piece.size()), boundary.force_on_fluid.friction(), Vec::Zero()};
  for (std::size_t k = 0; k < fluid.count; ++k) rubbed.momentum_rate += fluid.m[k] * at(fluid.a, k);
  for (std::size_t k = 0; k < boundary.count; ++k)
    rubbed.on_piece[boundary.id[k]] = at(boundary.friction_force, k);
  return rubbed;
}

void expect_near(const Vec& value, const Vec& expected) {
  EXPECT_LT((value - expected).norm(), 1e-12 * expected.norm())
      << value.transpose() << " instead of " << expected.transpose();
}

const SurfacePoint s_point{{0.01, -0.05}, {0.1, 0.0}, {0.02, 0.09}};
const Point f_point{.x = {0.03, 0.05}, .v = {0.7, -0.2}, .rho = 1010, .m = 9, .p = 800};

Vec direction(const Point& f, const SurfacePoint& s) {
  const Vec v_fs = f.v - s.v;
  return v_fs / std::sqrt(v_fs.squaredNorm() + eps * eps);
}

double V_W(const Point& f, const SurfacePoint& s) {
  return f.m / f.rho * kernel.value((f.x - s.x).norm());
}

TEST(Friction, OfOnePairAsPrintedIsEquation33) {
  const Rubbed rubbed = rub({s_point}, {f_point}, FrictionForm::as_printed);
  const Vec force = mu_A * V_W(f_point, s_point) * 800 * d_0 * direction(f_point, s_point);
  expect_near(rubbed.on_piece[0], force);
  expect_near(rubbed.on_fluid, -force);
}

TEST(Friction, OfOnePairNormalisedIsTheCoefficientTimesPressureTimesArea) {
  const Rubbed rubbed = rub({s_point}, {f_point}, FrictionForm::normalised);
  const Vec force = mu_A * 800 * std::hypot(0.02, 0.09) * direction(f_point, s_point);
  expect_near(rubbed.on_piece[0], force);
  expect_near(rubbed.on_fluid, -force);
}

/// Moved so far from the axis that no image is near.
Rubbed rub_far_out(FrictionForm form) {
  SurfacePoint s = s_point;
  Point f = f_point;
  s.x[1] += 1, f.x[1] += 1;
  f.m *= circumference(f.x[1]);
  return rub({s}, {f}, form, 0, Geometry::axisymmetric);
}

TEST(FrictionAboutAnAxis, IsTheCoefficientTimesPressureTimesTheAreaOfTheRing) {
  const Rubbed rubbed = rub_far_out(FrictionForm::normalised);
  const double pi = std::numbers::pi, side = 2 * pi * 0.95 * 0.02, outside = 2 * pi * (0.95 + 0.045) * 0.09;
  const Vec force = mu_A * 800 * std::hypot(side, outside) * direction(f_point, s_point);
  expect_near(rubbed.on_piece[0], force);
  expect_near(rubbed.on_fluid, -force);
  expect_near(rubbed.momentum_rate, -force);
}

TEST(FrictionAboutAnAxis, AsPrintedIsThatOfTheFluidsRing) {
  const Rubbed rubbed = rub_far_out(FrictionForm::as_printed);
  const double ring = 2 * std::numbers::pi * 1.05;
  const Vec force = ring * mu_A * V_W(f_point, s_point) * 800 * d_0 * direction(f_point, s_point);
  expect_near(rubbed.on_piece[0], force);
  expect_near(rubbed.momentum_rate, -force);
}

/// A pin's last row and the medium on it, which all reach beyond the axis.
TEST(FrictionAboutAnAxis, IsEqualAndOppositeAlongItAmongImages) {
  const std::vector<SurfacePoint> pin{{{0.01, 0.05}, {0, 0}, {0, 0.1}}, {{0.11, 0.05}, {0, 0}, {0.1, 0.1}}};
  const std::vector<Point> medium{{.x = {0.0, 0.14}, .v = {0.7, -0.2}, .rho = 1010, .m = 9, .p = 800},
                                  {.x = {0.2, 0.03}, .v = {0.4, 0.1}, .rho = 1000, .m = 2, .p = 500}};
  const Rubbed rubbed = rub(pin, medium, FrictionForm::normalised, 0, Geometry::axisymmetric);
  double on_pin = 0;
  for (const Vec& force : rubbed.on_piece) on_pin += force[0];
  EXPECT_GT(on_pin, 10);
  EXPECT_NEAR(rubbed.on_fluid[0], -on_pin, 1e-12 * on_pin);
  EXPECT_NEAR(rubbed.momentum_rate[0], -on_pin, 1e-12 * on_pin);
}

TEST(Friction, IsThatOfThePressureAtWhichTheMediumIsHeld) {
  const Rubbed rubbed = rub({s_point}, {f_point}, FrictionForm::normalised, 200);
  const Vec force = mu_A * 1000 * std::hypot(0.02, 0.09) * direction(f_point, s_point);
  expect_near(rubbed.on_piece[0], force);
  expect_near(rubbed.on_fluid, -force);
}

TEST(Friction, OfSeveralIsTheirSum) {
  const SurfacePoint inside{{0.04, -0.13}, {0.1, 0.3}, {0, 0}};
  const Point suction{.x = {0.08, 0.04}, .v = {0.3, 0.4}, .rho = 990, .m = 11, .p = -500};
  const Point other{.x = {-0.02, 0.06}, .v = {-0.3, 0.1}, .rho = 1000, .m = 10, .p = 300};
  const std::vector<Point> fluid{f_point, suction, other};
  const Rubbed printed = rub({s_point, inside}, fluid, FrictionForm::as_printed);
  const Rubbed normalised = rub({s_point, inside}, fluid, FrictionForm::normalised);
  std::vector<Vec> sums;
  for (const auto& s : {s_point, inside})
    sums.push_back(
        mu_A * (V_W(f_point, s) * 800 * direction(f_point, s) + V_W(other, s) * 300 * direction(other, s)));
  expect_near(printed.on_piece[0], d_0 * sums[0]);
  expect_near(printed.on_piece[1], d_0 * sums[1]);
  double contact = 0;  // which what is under suction counts to
  for (const auto& f : fluid) contact += V_W(f, s_point);
  expect_near(normalised.on_piece[0], std::hypot(0.02, 0.09) / contact * sums[0]);
  EXPECT_EQ(normalised.on_piece[1], Vec(0, 0));
}

TEST(Friction, IsNotTransmittedUnderSuction) {
  Point f = f_point;
  f.p = -800;
  for (const auto form : {FrictionForm::normalised, FrictionForm::as_printed}) {
    const Rubbed rubbed = rub({s_point}, {f}, form);
    EXPECT_EQ(rubbed.on_piece[0], Vec(0, 0));
    EXPECT_EQ(rubbed.on_fluid, Vec(0, 0));
  }
}

TEST(Friction, IsRegularAtRest) {
  Point f = f_point;
  f.v = s_point.v;
  EXPECT_EQ(rub({s_point}, {f}, FrictionForm::normalised).on_piece[0], Vec(0, 0));
  const Vec creep(1e-3 * eps, -2e-3 * eps);
  f.v += creep;
  const Vec drag = mu_A * 800 * s_point.area_vector.norm() / eps * creep;  // linear to the third order
  EXPECT_LT((rub({s_point}, {f}, FrictionForm::normalised).on_piece[0] - drag).norm(), 1e-5 * drag.norm());
}

TEST(Friction, FadesWhereTheFluidParts) {
  Point f = f_point;
  f.x = s_point.x + Vec(0, 1.99 * h);
  const double contact = V_W(f, s_point);
  ASSERT_LT(contact, 1e-3 * least_contact);
  expect_near(rub({s_point}, {f}, FrictionForm::normalised).on_piece[0],
              mu_A * 800 * s_point.area_vector.norm() * contact / least_contact * direction(f, s_point));
}

/// Disordered fluid above a surface along x with `rows` rows, sliding at (1, 0).
struct Plane {
  std::vector<SurfacePoint> piece;
  std::vector<Point> fluid;
};
Plane plane(double disorder) {
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return disorder * d_0 * (state / 4294967296.0 - 0.5) * 2;
  };
  Plane plane;
  for (int a = 0; a < 30; ++a) {
    for (int b = 0; b < 4; ++b)
      plane.piece.push_back({{(a + 0.5) * d_0, -(b + 0.5) * d_0}, {0, 0}, {0, b == 0 ? d_0 : 0}});
    for (int b = 0; b < 6; ++b) {
      const Vec x((a + 0.5) * d_0 + noise(), (b + 0.5) * d_0 + noise());
      plane.fluid.push_back({.x = x, .v = {1, 0}, .rho = 1000, .m = 1000 * d_0 * d_0, .p = 600});
    }
  }
  return plane;
}

TEST(Friction, FluidReceivesTheExactOpposite) {
  for (const auto form : {FrictionForm::normalised, FrictionForm::as_printed}) {
    const auto [piece, fluid] = plane(0.3);
    const Rubbed rubbed = rub(piece, fluid, form);
    Vec on_piece = Vec::Zero();
    double size = 0;
    for (const Vec& force : rubbed.on_piece) on_piece += force, size += force.norm();
    EXPECT_GT(on_piece[0], 0);
    EXPECT_LT((on_piece + rubbed.on_fluid).norm(), 1e-14 * size);
    EXPECT_LT((on_piece + rubbed.momentum_rate).norm(), 1e-14 * size);
  }
}

/// Traction over mu_A p, away from the ends.
double transmitted(FrictionForm form, double disorder) {
  const auto [piece, fluid] = plane(disorder);
  const Rubbed rubbed = rub(piece, fluid, form);
  double force = 0;
  for (std::size_t k = 0; k < piece.size(); ++k)
    if (piece[k].x[0] > 5 * d_0 && piece[k].x[0] < 25 * d_0) force += rubbed.on_piece[k][0];
  return force / (20 * d_0) / (mu_A * 600);
}

TEST(Friction, OfAPlaneInterfaceIsTheCoefficientTimesThePressure) {
  EXPECT_NEAR(transmitted(FrictionForm::normalised, 0), 1, 1e-6);
  EXPECT_NEAR(transmitted(FrictionForm::normalised, 0.3), 1, 1e-6);
}

TEST(Friction, AsPrintedTransmitsOnlyAShareOfIt) {
  EXPECT_NEAR(transmitted(FrictionForm::as_printed, 0), printed_share(CubicSpline(1.2), 1), 1e-6);
  EXPECT_NEAR(printed_share(CubicSpline(1.0), 1), 0.16, 0.005);
  EXPECT_NEAR(printed_share(CubicSpline(1.2), 1), 0.22, 0.005);
  EXPECT_NEAR(printed_share(CubicSpline(1.3), 1), 0.25, 0.005);
  EXPECT_NEAR(printed_share(CubicSpline(1.5), 1), 0.30, 0.005);
}

TEST(Friction, SaysWhatItTransmits) {
  const auto said = [](FrictionForm form) {
    return text(Friction{.coefficient = mu_A, .form = form}, Medium{1000, 20, d_0, kernel}).parameters;
  };
  EXPECT_THAT(said(FrictionForm::as_printed),
              testing::HasSubstr("a plane interface transmits only about 0.22 mu_A p at h = 1.2 d_0"));
  EXPECT_THAT(said(FrictionForm::normalised), testing::HasSubstr("a plane interface transmits mu_A p"));
  EXPECT_THAT(said(FrictionForm::normalised), testing::HasSubstr("eps 0.02 m/s"));  // c_0/1000
}

// In the solver -------------------------------------------------------------------------------------------

/// Water that slides over a floor, the work piece.
Setting sliding_water() {
  Setting setting = collapsing_column();
  setting.scene.walls[0].work_piece = true;
  setting.parameters.friction = Friction{.coefficient = mu_A};
  setting.parameters.wall_model.slip = WallSlip::free_slip;
  setting.parameters.hydrostatic_start = HydrostaticStart{0.8};
  return setting;
}

TEST(FrictionInTheSolver, NeedsNoMemoryWhereItIsAbsent) {
  Setting setting = sliding_water();
  setting.parameters.friction.reset();
  WeaklyCompressible solver = setting.solver();
  solver.advance(1e-4);
  for (const auto& boundary : solver.boundaries()) {
    EXPECT_TRUE(boundary.friction_length.empty());
    EXPECT_TRUE(boundary.friction_force[0].empty());
  }
  for (const auto& term : solver.active_terms()) EXPECT_NE(term.name, "friction");
}

TEST(FrictionInTheSolver, BrakesTheSurge) {
  Setting with = sliding_water(), without = sliding_water();
  without.parameters.friction.reset();
  WeaklyCompressible a = with.solver(), b = without.solver();
  run_until(a, 0.15);
  run_until(b, 0.15);
  EXPECT_GT(b.momentum()[0], 0);
  EXPECT_LT(a.momentum()[0], 0.97 * b.momentum()[0]);
}

TEST(FrictionInTheSolver, LimitsTheStepAsALinearDragAtRest) {
  Setting setting = sliding_water();
  setting.parameters.friction->regularisation_speed = 1e-4;
  const WeaklyCompressible solver = setting.solver();
  EXPECT_EQ(solver.time_step_rule(), "friction");
  double p = 0;
  for (const double rho : solver.particles().rho) p = std::max(p, EquationOfState{1000, 20, 7}.pressure(rho));
  EXPECT_NEAR(solver.time_step_limit(), 0.5 * 1000 * 0.05 * 1e-4 / (mu_A * p), 1e-12);
  setting.parameters.friction->form = FrictionForm::as_printed;
  EXPECT_NEAR(setting.solver().time_step_limit(),
              solver.time_step_limit() / printed_share(CubicSpline(1.3), 1), 1e-12);
}

TEST(FrictionInTheSolverRun, StaysAtRestAtItsLimit) {
  Setting setting = sliding_water();
  setting.parameters.regions.front().box.max = Vec(1.0, 0.4);
  setting.parameters.hydrostatic_start = HydrostaticStart{0.4};
  setting.parameters.friction->regularisation_speed = 2e-3;
  WeaklyCompressible solver = setting.solver();
  ASSERT_EQ(solver.time_step_rule(), "friction");
  run_until(solver, 0.05);
  double sliding = 0;  // of the row on the floor
  for (std::size_t k = 0; k < solver.particle_count(); ++k)
    if (solver.particles().x[1][k] < 0.05) sliding = std::max(sliding, std::abs(solver.particles().v[0][k]));
  EXPECT_LT(sliding, 3e-3 * 2e-3);  // unstable, it reaches a hundredth of eps within this time
}

}  // namespace
}  // namespace toryu::fluid
