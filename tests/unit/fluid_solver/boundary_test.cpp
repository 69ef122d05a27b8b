// Pressure and velocity that walls take from the fluid, (27)-(29).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "fluid_solver/face_depths.hpp"
#include "fluid_solver/wall_extrapolation.hpp"

namespace toryu::fluid {
namespace boundary_test {

constexpr double d_0 = 0.1, h = 1.3 * d_0;
const CubicSpline kernel(h);

struct Fluid {
  std::vector<Vec> x, v;
  std::vector<double> p, rho;
};

/// `fluid` in strip order.
std::pair<Particles, StripOrder> in_order(const Fluid& fluid) {
  Particles f;
  f.count = fluid.x.size();
  for (auto* field : {&f.x, &f.v}) resize(*field, padded(f.count));
  for (auto* field : {&f.p, &f.rho}) field->resize(padded(f.count), 0.0);
  StripOrder strips(0.3);
  Field x, y;
  for (const Vec& point : fluid.x) x.push_back(point[0]), y.push_back(point[1]);
  const auto order = strips.sort(x, y, f.count);
  for (std::size_t k = 0; k < f.count; ++k) {
    set(f.x, k, fluid.x[order[k]]);
    set(f.v, k, fluid.v[order[k]]);
    f.p[k] = fluid.p[order[k]];
    f.rho[k] = fluid.rho[order[k]];
  }
  strips.index(f.x[0], f.count);
  return {f, strips};
}

/// Wall particles at `places` with what they take from `fluid`; particle k of the result is places[k].
struct Taken {
  std::vector<double> p;
  std::vector<Vec> v_viscous, slip = {};
  std::vector<double> stress = {};
};
/// With slip where there are `sliding` terms; a work piece then.
Taken extrapolated(const std::vector<Vec>& places, const Fluid& fluid, const Vec& g, const Vec& v_w = {0, 0},
                   const Vec& a_w = {0, 0}, bool fitted = false, const OptionalTerms* sliding = nullptr,
                   double p_offset = 0, const Outline* outline = nullptr) {
  Boundary boundary;
  boundary.place(places, std::vector<double>(places.size(), d_0 * d_0), 1000, 0.3);
  const std::vector<const Outline*> outlines(places.size(), outline);
  if (fitted || sliding)
    boundary.know_faces(face_depths(places, outlines, d_0, 4 * kernel.support()), fitted);
  if (sliding) {
    boundary.make_work_piece(std::vector<Faces>(places.size(), faces_of(Vec(0, d_0))));
    resize(boundary.slip_velocity, padded(places.size()));
    boundary.shear_stress.resize(padded(places.size()));
  }
  boundary.move_to([&](std::uint32_t k) { return Kinematics{places[k], v_w, a_w}; });
  const auto ordered = in_order(fluid);
  const Particles& particles = ordered.first;
  const StripOrder& strips = ordered.second;
  boundary.list_for_wall.build(boundary.x, boundary.count, particles.x, strips, 1.1 * kernel.support());
#pragma omp parallel
  {
    extrapolate(boundary, particles, kernel, g);
    if (sliding) let_slide(boundary, particles, kernel, *sliding, p_offset);
  }
  Taken taken{std::vector<double>(places.size()), std::vector<Vec>(places.size())};
  taken.slip.resize(places.size());
  taken.stress.resize(places.size());
  for (std::size_t k = 0; k < boundary.count; ++k) {
    taken.p[boundary.id[k]] = boundary.p[k];
    taken.v_viscous[boundary.id[k]] = at(boundary.v_viscous, k);
    if (!sliding) continue;
    taken.slip[boundary.id[k]] = at(boundary.slip_velocity, k);
    taken.stress[boundary.id[k]] = boundary.shear_stress[k];
  }
  return taken;
}

const Vec g(0, -9.81);

TEST(WallExtrapolation, OfOneParticleIsItsPressureAndTheWeightBetween) {
  const Fluid one{{{0.02, 0.05}}, {{0.3, -0.7}}, {500}, {1003}};
  const Vec place(0, -0.05), a_w(2, -1);
  const Taken taken = extrapolated({place}, one, g, {0.1, 0.2}, a_w);
  EXPECT_NEAR(taken.p[0], 500 + 1003 * (g - a_w).dot(place - one.x[0]), 1e-9);
  EXPECT_LT((taken.v_viscous[0] - (2 * Vec(0.1, 0.2) - one.v[0])).norm(), 1e-12);
}

TEST(WallExtrapolation, OfTwoParticlesIsTheirKernelMean) {
  const Fluid two{{{0.02, 0.05}, {0.10, 0.06}}, {{1, 0}, {0, 1}}, {500, 700}, {1003, 1010}};
  const Vec place(0.03, -0.05);
  const double W_0 = kernel.value((place - two.x[0]).norm()), W_1 = kernel.value((place - two.x[1]).norm());
  const double p_w = (500 * W_0 + 700 * W_1 + g.dot(1003 * W_0 * (place - two.x[0])) +
                      g.dot(1010 * W_1 * (place - two.x[1]))) /
                     (W_0 + W_1);
  const Taken taken = extrapolated({place}, two, g);
  EXPECT_NEAR(taken.p[0], p_w, 1e-10 * p_w);
  const Vec mean = (W_0 * two.v[0] + W_1 * two.v[1]) / (W_0 + W_1);
  EXPECT_LT((taken.v_viscous[0] + mean).norm(), 1e-12);
}

/// Water of constant density under the acceleration `field`, and two rows of wall below it.
std::pair<Fluid, std::vector<Vec>> water_over_wall(const Vec& field) {
  Fluid fluid;
  std::vector<Vec> wall;
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < 8; ++b) {
      fluid.x.emplace_back((a + 0.5) * d_0, (b + 0.5) * d_0);
      fluid.v.emplace_back(0.25, 0.5);
      fluid.p.push_back(8000 + 1000 * field.dot(fluid.x.back()));
      fluid.rho.push_back(1000);
    }
    for (int b = 1; b <= 2; ++b) wall.emplace_back((a + 0.5) * d_0, (0.5 - b) * d_0);
  }
  return {fluid, wall};
}

TEST(WallExtrapolation, ContinuesHydrostaticPressureExactly) {
  const auto [fluid, wall] = water_over_wall(g);
  const Taken taken = extrapolated(wall, fluid, g);
  for (std::size_t k = 0; k < wall.size(); ++k)
    EXPECT_NEAR(taken.p[k], 8000 + 1000 * g.dot(wall[k]), 1e-7) << wall[k].transpose();
}

TEST(WallExtrapolation, ContinuesThePressureOfAnAcceleratedTankExactly) {
  const Vec a_w(3, 2);
  const auto [fluid, wall] = water_over_wall(g - a_w);
  const Taken taken = extrapolated(wall, fluid, g, {0, 0}, a_w);
  for (std::size_t k = 0; k < wall.size(); ++k)
    EXPECT_NEAR(taken.p[k], 8000 + 1000 * (g - a_w).dot(wall[k]), 1e-7) << wall[k].transpose();
}

TEST(WallExtrapolation, MirrorsAUniformVelocityAtTheWall) {
  const auto [fluid, wall] = water_over_wall(g);
  const Taken taken = extrapolated({wall[0], wall[10]}, fluid, g, {1, 0});
  for (const Vec& v : taken.v_viscous) EXPECT_LT((v - Vec(1.75, -0.5)).norm(), 1e-12);
}

TEST(WallExtrapolation, LeavesAWallWithoutFluidUnderNoPressure) {
  const auto [fluid, wall] = water_over_wall(g);
  const Taken taken = extrapolated({wall[0], {0.05, -0.3}, {9, 9}}, fluid, g);
  EXPECT_GT(taken.p[0], 0);
  EXPECT_EQ(taken.p[1], 0);
  EXPECT_EQ(taken.p[2], 0);
}

/// Fluid on a lattice over a wall of three rows, both disordered as `disorder` says, with a velocity of the
/// distance from the face.
std::pair<Fluid, std::vector<Vec>> shear_over_wall(double disorder, const std::function<double(double)>& u) {
  Fluid fluid;
  std::vector<Vec> wall;
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < 8; ++b) {
      const Vec shift = disorder * d_0 * Vec(std::sin(5 * a + 3 * b), std::cos(7 * a - 2 * b));
      fluid.x.push_back(Vec((a + 0.5) * d_0, (b + 0.5) * d_0) + shift);
      fluid.v.emplace_back(u(fluid.x.back()[1]), 0);
      fluid.p.push_back(100);
      fluid.rho.push_back(1000);
    }
    for (int b = 1; b <= 3; ++b) wall.emplace_back((a + 0.5) * d_0, (0.5 - b) * d_0);
  }
  return {fluid, wall};
}

TEST(WallFit, ContinuesAShearExactlyHoweverTheFluidLies) {
  for (const Vec& v_w : {Vec(0, 0), Vec(0.7, 0)}) {
    const auto [fluid, wall] = shear_over_wall(0.2, [&](double y) { return v_w[0] + 3 * y; });
    const Taken taken = extrapolated(wall, fluid, g, v_w, {0, 0}, true);
    for (std::size_t k = 3 * 4; k < 3 * 8 + 2; ++k)  // two rows that see fluid
      if (k % 3 < 2) {
        EXPECT_LT((taken.v_viscous[k] - v_w - Vec(3 * wall[k][1], 0)).norm(), 1e-12);
      }
  }
}

TEST(WallFit, ContinuesAParabolaBetterThanTheMean) {
  const auto u = [](double y) { return 3 * y - 2 * y * y; };
  const auto [fluid, wall] = shear_over_wall(0, u);
  const Taken fit = extrapolated(wall, fluid, g, {0, 0}, {0, 0}, true), mean = extrapolated(wall, fluid, g);
  const double first = u(wall[3 * 5][1]), second = u(wall[3 * 5 + 1][1]);
  EXPECT_NEAR(fit.v_viscous[3 * 5][0] / first, 1.0, 0.03);
  EXPECT_NEAR(fit.v_viscous[3 * 5 + 1][0] / second, 1.0, 0.15) << "sees a single row: a line";
  EXPECT_LT(mean.v_viscous[3 * 5 + 1][0] / second, 0.5);
}

TEST(WallFit, OfASingleRowIsALine) {
  const Fluid one{{{0.02, 0.05}}, {{0.3, -0.7}}, {500}, {1003}};
  const Taken taken = extrapolated({{0, -0.08}}, one, g, {0, 0}, {0, 0}, true);  // its face at -0.03
  EXPECT_LT((taken.v_viscous[0] + 0.05 / 0.08 * one.v[0]).norm(), 1e-12);
}

TEST(WallFit, LeavesTheMeanBehindAnInnerCorner) {
  std::vector<Vec> corner;
  for (int a = -3; a < 6; ++a)
    for (int b = -3; b < 6; ++b)
      if (a < 0 || b < 0) corner.emplace_back((a + 0.5) * d_0, (b + 0.5) * d_0);
  Fluid fluid;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      fluid.x.emplace_back((a + 0.5) * d_0, (b + 0.5) * d_0);
      fluid.v.emplace_back(fluid.x.back()[0] * fluid.x.back()[1], 0);
      fluid.p.push_back(100);
      fluid.rho.push_back(1000);
    }
  const Taken fit = extrapolated(corner, fluid, g, {0, 0}, {0, 0}, true);
  const Taken mean = extrapolated(corner, fluid, g);
  const Vec inner(-0.05, -0.05), beside(-0.05, 0.25);
  for (std::size_t k = 0; k < corner.size(); ++k) {
    if ((corner[k] - inner).norm() < 1e-9) {
      EXPECT_EQ(fit.v_viscous[k], mean.v_viscous[k]);
    }
    if ((corner[k] - beside).norm() < 1e-9) {
      EXPECT_NE(fit.v_viscous[k], mean.v_viscous[k]);
    }
  }
}

OptionalTerms sliding(double eta, const SlipLaw& law) {
  OptionalTerms terms;
  terms.laminar_viscosity = LaminarViscosity{eta};
  terms.wall_slip = law;
  return terms;
}

/// A particle of the fluid 0.08 m before the face, a wall particle 0.05 m behind it.
const Fluid above{{{0.02, 0.05}}, {{0.3, -0.7}}, {500}, {1003}};
const Vec below(0, -0.08);

TEST(WallSlip, OfOnePairIsThatOfTheSlipLength) {
  const OptionalTerms terms = sliding(20, {.coefficient = 0.006});  // b eta = 0.12 m
  for (const bool fitted : {true, false}) {
    const Taken taken = extrapolated({below}, above, g, {0.1, 0}, {0, 0}, fitted, &terms);
    const double gdot = 0.2 / (0.08 + 0.12), u_s = 0.12 * gdot;  // of 0.3 - 0.1 m/s
    EXPECT_NEAR(taken.slip[0][0], u_s, 1e-9);
    EXPECT_EQ(taken.slip[0][1], 0) << "none through the wall";
    EXPECT_NEAR(taken.stress[0], 20 * gdot, 1e-7);
    const double v_f = fitted ? 0.1 + u_s - 0.05 * gdot : 2 * (0.1 + u_s) - 0.3;
    EXPECT_NEAR(taken.v_viscous[0][0], v_f, 1e-9);
    EXPECT_NEAR(taken.v_viscous[0][1], fitted ? 0.7 * 0.05 / 0.08 : 0.7, 1e-12);
  }
}

TEST(WallSlip, OfOnePairByAPowerAboveAThreshold) {
  // gdot_0 = 0.3/0.08 = 3.75 1/s, tau = 20 gdot, u_s = b (tau - 10)^2: gdot = 2.5 where b = 0.1/40^2
  const OptionalTerms terms = sliding(20, {.coefficient = 0.1 / 1600, .exponent = 2, .threshold = 10});
  const Taken taken = extrapolated({below}, above, g, {0, 0}, {0, 0}, true, &terms);
  EXPECT_NEAR(taken.slip[0][0], 0.1, 1e-8);
  EXPECT_NEAR(taken.stress[0], 50, 1e-6);
  const OptionalTerms sticks = sliding(20, {.coefficient = 1, .exponent = 2, .threshold = 76});
  EXPECT_EQ(extrapolated({below}, above, g, {0, 0}, {0, 0}, true, &sticks).slip[0], Vec(0, 0));
}

TEST(WallSlip, WithoutACoefficientIsNoSlipToTheBit) {
  const OptionalTerms none = sliding(20, {.coefficient = 0});
  for (const bool fitted : {true, false}) {
    const auto [fluid, wall] = shear_over_wall(0.2, [](double y) { return 0.7 + 3 * y - 2 * y * y; });
    const Taken slips = extrapolated(wall, fluid, g, {0.1, 0}, {0, 0}, fitted, &none);
    const Taken sticks = extrapolated(wall, fluid, g, {0.1, 0}, {0, 0}, fitted);
    EXPECT_EQ(slips.v_viscous, sticks.v_viscous);
    EXPECT_GT(slips.stress[3 * 5], 0);
  }
}

TEST(WallSlip, WithoutBoundLeavesNoShear) {
  const OptionalTerms free = sliding(20, {.coefficient = 1e9});
  for (const bool fitted : {true, false}) {
    const Taken taken = extrapolated({below}, above, g, {0, 0}, {0, 0}, fitted, &free);
    EXPECT_NEAR(taken.v_viscous[0][0], 0.3, 1e-7);
    EXPECT_NEAR(taken.stress[0], 0, 1e-7);
  }
}

TEST(WallSlip, ContinuesAShearThatSlidesExactlyHoweverTheFluidLies) {
  const OptionalTerms terms = sliding(20, {.coefficient = 0.006});
  const auto [fluid, wall] = shear_over_wall(0.2, [](double y) { return 0.7 + 3 * (y + 0.12); });
  const Taken taken = extrapolated(wall, fluid, g, {0.7, 0}, {0, 0}, true, &terms);
  for (std::size_t k = 3 * 4; k < 3 * 8 + 2; ++k)
    if (k % 3 < 2) {
      EXPECT_NEAR(taken.slip[k][0], 0.36, 1e-9);
      EXPECT_NEAR(taken.stress[k], 60, 1e-6);
      EXPECT_NEAR(taken.v_viscous[k][0], 0.7 + 3 * (wall[k][1] + 0.12), 1e-9);
    }
}

TEST(WallSlip, BearsNoMoreThanTheFrictionOfAWorkPiece) {
  OptionalTerms terms = sliding(20, {.coefficient = 0.006});  // 30 Pa by the slip alone
  terms.friction = Friction{.coefficient = 0.01};
  const auto at_offset = [&](double offset) {
    return extrapolated({below}, above, Vec(0, 0), {0, 0}, {0, 0}, true, &terms, offset);
  };
  EXPECT_NEAR(at_offset(0).stress[0], 5, 1e-6) << "mu_A p of 500 Pa";
  EXPECT_NEAR(at_offset(0).slip[0][0], 0.3 - 0.08 * 5 / 20, 1e-9);
  EXPECT_NEAR(at_offset(1000).stress[0], 15, 1e-6);
  EXPECT_NEAR(at_offset(1e5).stress[0], 30, 1e-6) << "the law's own";
  EXPECT_EQ(at_offset(-600).stress[0], 0) << "under suction";
}

TEST(WallFit, ContinuesAShearOverASlantedOutlineExactly) {
  auto [fluid, wall] = shear_over_wall(0.2, [](double y) { return 0.7 + 3 * y; });
  const auto turned = [](const Vec& x) {
    return Vec(std::cos(0.3) * x[0] - std::sin(0.3) * x[1], std::sin(0.3) * x[0] + std::cos(0.3) * x[1]);
  };
  const auto depth_of = wall;
  for (auto* vectors : {&fluid.x, &fluid.v, &wall})
    for (Vec& v : *vectors) v = turned(v);
  Outline::Ring ring = ring_of(Box{Vec(-9, -9), Vec(9, 0)});
  for (Vec& corner : ring) corner = turned(corner);
  const Outline outline({ring});
  const Taken taken = extrapolated(wall, fluid, g, turned({0.7, 0}), {0, 0}, true, nullptr, 0, &outline);
  for (std::size_t k = 3 * 4; k < 3 * 8 + 2; ++k)
    if (k % 3 < 2) {
      const Vec expected = turned({0.7 + 3 * depth_of[k][1], 0});
      EXPECT_LT((taken.v_viscous[k] - expected).norm(), 1e-9);
    }
}

/// Particles in three rows about the middle, `side` of the circle.
std::vector<Vec> rows_beside_circle(double radius, double side) {
  std::vector<Vec> rows;
  for (const double row : {0.5, 1.5, 2.5}) {
    const double r = radius + side * row * d_0, count = std::round(2 * M_PI * r / d_0);
    for (double k = 0; k < count; ++k)
      rows.emplace_back(r * std::cos(2 * M_PI * k / count), r * std::sin(2 * M_PI * k / count));
  }
  return rows;
}

TEST(WallFit, ContinuesAShearOverARoundOutlineOnEitherSide) {
  constexpr double radius = 6 * d_0;
  const Outline::Ring circle = ellipse_ring({0, 0}, {radius, radius});
  for (const double side : {1, -1}) {  // of the fluid
    const auto distance = [&](const Vec& x) { return side * (x.norm() - radius); };
    const auto wall = rows_beside_circle(radius, -side);
    Fluid fluid;
    for (const Vec& x : rows_beside_circle(radius, side)) {
      fluid.x.push_back(x);
      fluid.v.emplace_back(3 * distance(x), 0);
      fluid.p.push_back(100);
      fluid.rho.push_back(1000);
    }
    const Outline outline =
        side > 0 ? Outline({circle}) : Outline({ring_of(Box{Vec(-9, -9), Vec(9, 9)}), circle});
    const Taken taken = extrapolated(wall, fluid, g, {0, 0}, {0, 0}, true, nullptr, 0, &outline);
    for (std::size_t k = 0; k < wall.size(); ++k)
      if (const double d_w = distance(wall[k]); d_w > -2 * d_0) {  // two rows that see fluid
        EXPECT_LT((taken.v_viscous[k] - Vec(3 * d_w, 0)).norm(), 0.015 * 3 * std::abs(d_w))
            << wall[k].transpose();
      }
  }
}

TEST(FaceDepths, KnowTheCurvatureOfTheirOutlineButAtCorners) {
  const Outline disc({ellipse_ring({0, 0}, {5, 5})}),
      ring({ellipse_ring({0, 0}, {20, 20}), ellipse_ring({0, 0}, {5, 5})}),
      corners({{{0, 0}, {40, 0}, {40, 40}, {20, 40}, {20, 20}, {0, 20}}});
  const auto curvature = [](const Outline& outline, const Vec& x) {
    return face_depths({x}, {&outline}, 1.0, 10).curvature[0];
  };
  EXPECT_NEAR(curvature(disc, {3, 2}), 0.2, 0.001);
  EXPECT_NEAR(curvature(ring, {4, 4}), -0.2, 0.001);
  EXPECT_EQ(curvature(corners, {10, 1}), 0);
  EXPECT_EQ(curvature(corners, {1, 2}), 0) << "beside an outer corner";
  EXPECT_EQ(curvature(corners, {22, 18}), 0) << "behind an inner corner";
  const Outline chamfer({{{0, 0}, {40, 0}, {40, 40}, {20, 20}, {0, 20}}});
  EXPECT_EQ(curvature(chamfer, {20.57, 18.61}), 0) << "behind an inner corner of 45 degrees";
  const Outline tiny({ellipse_ring({0, 0}, {1, 1})});
  EXPECT_EQ(curvature(tiny, {0.5, 0}), 0) << "as a corner";
}

TEST(FaceDepths, OfAnOutlineAreItsNearestPoint) {
  const Outline triangle({{{0, 0}, {4, 0}, {0, 4}}});
  const FaceDepths depths = face_depths({{1.5, 1.5}, {9, 9}}, {&triangle, nullptr}, 1.0, 10);
  EXPECT_LT((depths.to_outline[0] - Vec(0.5, 0.5)).norm(), 1e-15);
  EXPECT_EQ(depths.to_outline[1], Vec(0, 0));
  EXPECT_EQ(depths.up[0], Vec(10, 10));
  EXPECT_EQ(depths.up[1], Vec(0.5, 0.5));
}

TEST(FaceDepths, AreHowFarTheBodyGoesOn) {
  const std::vector<Vec> L = {{0.5, 0.5}, {1.5, 0.5}, {0.5, 1.5}, {0.5, 2.5}};
  const FaceDepths depths = lattice_face_depths(L, 1.0, 10);
  EXPECT_EQ(depths.up[0], Vec(1.5, 2.5));
  EXPECT_EQ(depths.down[0], Vec(0.5, 0.5));
  EXPECT_EQ(depths.up[1], Vec(0.5, 0.5));
  EXPECT_EQ(depths.down[3], Vec(0.5, 2.5));
  EXPECT_EQ(lattice_face_depths(L, 1.0, 2).up[0], Vec(1.5, 2.0)) << "no farther than is asked for";
}

}  // namespace boundary_test
}  // namespace toryu::fluid
