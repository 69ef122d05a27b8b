// Flow about an axis: pairs worked by hand, uniform states, what is kept, and the images beyond the axis.
#include "fluid_solver/axisymmetry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace axisymmetry_test {

constexpr double h = 0.1, area = 0.0025, pi = std::numbers::pi;

/// A ring of the area `A` [m2].
struct Ring : Point {
  double A = area;
};
Ring ring(const Vec& x, const Vec& v, double rho, double p, double A = area) {
  Ring made;
  made.x = x, made.v = v, made.rho = rho, made.p = p, made.A = A;
  made.m = 2 * pi * std::abs(x[1]) * rho * A;
  return made;
}

template <class Add>
Rates rates_of(const Ring& i, const std::vector<Ring>& others, Add&& add) {
  FewSources sources(std::vector<Point>(others.begin(), others.end()));
  for (std::size_t j = 0; j < others.size(); ++j) sources.V[j] = others[j].A;
  return sum_over(i, sources, CubicSpline(h), add);
}

const Ring ring_i = ring({0.3, 0.5}, {0.2, 0.4}, 1000, 3000),
           ring_j = ring({0.34, 0.57}, {-0.1, 0.7}, 1010, 800, 0.0024);

Rates of_pair(auto term) {
  return rates_of(ring_i, {ring_j},
                  [&](const Targets& i, const Sources& s, std::size_t j, const Pair& p, Rates& r) {
                    if constexpr (requires { term.density(i, s, j, p, r); }) term.density(i, s, j, p, r);
                    if constexpr (requires { term.momentum(i, s, j, p, r); }) term.momentum(i, s, j, p, r);
                    if constexpr (requires { term.viscous(i, s, j, p, r); }) term.viscous(i, s, j, p, r);
                    if constexpr (requires { term.diffusion(i, s, j, p, r); }) term.diffusion(i, s, j, p, r);
                  });
}

TEST(AxisymmetricPair, CompressesByItsPlaneAndItsHoop) {
  const Vec slope = grad_W(ring_i.x, ring_j.x, h), v_ij = ring_i.v - ring_j.v, x_ij = ring_i.x - ring_j.x;
  const double hoop = 0.4 / 0.5;
  EXPECT_NEAR(of_pair(RingContinuity{}).compression[0],
              0.0024 * (v_ij.dot(slope) + hoop * x_ij[1] * slope[1]), 1e-12);
}

TEST(AxisymmetricPair, PushesAlongTheAxisByRingsAndAcrossByPressuresAlone) {
  const Vec slope = grad_W(ring_i.x, ring_j.x, h);
  const double P_i = 3000 / 1e6, P_j = 800 / (1010.0 * 1010.0), rho_A_j = 1010 * 0.0024;
  const Vec a = first_lane(of_pair(RingPressure{}).a);
  EXPECT_NEAR(a[0], -rho_A_j * (P_i * 0.57 / 0.5 + P_j) * slope[0], 1e-9);
  EXPECT_NEAR(a[1], -rho_A_j * (P_i + P_j) * slope[1], 1e-9);
}

TEST(AxisymmetricPair, RubsByTheMeanOfItsRadiiOnWhatIsNotExpansion) {
  const Vec slope = grad_W(ring_i.x, ring_j.x, h), x_ij = ring_i.x - ring_j.x;
  Vec v_ij = ring_i.v - ring_j.v;
  v_ij[1] -= 0.4 / 0.5 * x_ij[1];
  const double mu = 2, G = slope.dot(x_ij) / x_ij.squaredNorm(), mean = 0.5 * (0.5 + 0.57) / 0.5;
  const Vec a = first_lane(of_pair(RingViscosity<LaminarViscosityTerm>{{mu}}).a);
  EXPECT_NEAR((a - 2 * mu / 1000 * 0.0024 * mean * G * v_ij).norm(), 0, 1e-9);
}

TEST(AxisymmetricPair, DiffusesAsMuchMassAsItsPartnerGains) {
  const RingDiffusion<DensityDiffusionTerm<false>> term{{3.0}};
  const auto rate = [&](const Ring& i, const Ring& j) {
    return rates_of(i, {j},
                    [&](const Targets& t, const Sources& s, std::size_t k, const Pair& p, Rates& r) {
                      term.diffusion(t, s, k, p, r);
                    })
               .diffusion[0] *
           2 * pi * i.x[1] * i.A;
  };
  EXPECT_NE(rate(ring_i, ring_j), 0);
  EXPECT_NEAR(rate(ring_i, ring_j), -rate(ring_j, ring_i), 1e-9 * std::abs(rate(ring_i, ring_j)));
}

/// A lattice about (0, r), images beyond the axis among it, of which the middle one is at its place.
std::vector<Ring> lattice_about(double r, const auto& ring_at) {
  std::vector<Ring> rings;
  for (int a = -5; a <= 5; ++a)
    for (int b = -5; b <= 5; ++b) rings.push_back(ring_at(Vec(0.05 * a, r + 0.05 * b)));
  return rings;
}

TEST(AxisymmetricLattice, KeepsItsDensityAndFeelsNothingWhereItStretches) {
  const double rate = 3;  // v_r = rate r, v_x = -2 rate x keeps the volume
  const auto ring_at = [&](const Vec& x) {
    Ring made = ring(x, {-2 * rate * x[0], rate * x[1]}, 1000, 700);
    made.eta = 5;
    made.eta_grad_v << 5 * -2 * rate, 0, 0, 5 * rate;
    return made;
  };
  for (const double r : {0.025, 0.075, 0.425}) {  // the first two see images
    const auto around = lattice_about(r, ring_at);
    const Ring i = ring_at({0, r});
    const auto sum = [&](auto&& add) { return rates_of(i, around, add); };
    const Rates continuity = sum([](const auto& t, const auto& s, std::size_t j, const auto& p, auto& q) {
      RingContinuity{}.density(t, s, j, p, q);
    });
    EXPECT_NEAR(continuity.compression[0], 0, 1e-10);
    const Rates varying = sum([](const auto& t, const auto& s, std::size_t j, const auto& p, auto& q) {
      RingViscosity<VariableViscosityTerm>{}.viscous(t, s, j, p, q);
    });
    EXPECT_NEAR(first_lane(varying.a).norm(), 0, 1e-10);
    const Rates laminar = sum([](const auto& t, const auto& s, std::size_t j, const auto& p, auto& q) {
      RingViscosity<LaminarViscosityTerm>{{5.0}}.viscous(t, s, j, p, q);
    });
    EXPECT_NEAR(first_lane(laminar.a).norm(), 0, 1e-10);
    const Rates pressure = sum([](const auto& t, const auto& s, std::size_t j, const auto& p, auto& q) {
      RingPressure{}.momentum(t, s, j, p, q);
    });
    EXPECT_NEAR(first_lane(pressure.a).norm(), 0, 1e-8);
  }
}

Setting about_axis() {
  Setting s = empty_space();
  s.parameters.artificial_viscosity.reset();
  s.parameters.laminar_viscosity = LaminarViscosity{20.0};
  s.scene.geometry = Geometry::axisymmetric;
  return s;
}

Setting closed_vessel() {
  Setting s = about_axis();
  s.parameters.background_pressure = BackgroundPressure{5e4};
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.5)}, Vec::Zero()}};
  s.scene.walls = {{"side", {Vec(-0.2, 0.5), Vec(1.2, 0.7)}, {}},
                   {"bottom", {Vec(-0.2, 0), Vec(0, 0.5)}, {}},
                   {"lid", {Vec(1, 0), Vec(1.2, 0.5)}, {}}};
  return s;
}

TEST(AxisymmetricFluid, StaysAtRestUnderAUniformPressure) {
  WeaklyCompressible solver = closed_vessel().solver();
  for (int step = 0; step < 20; ++step) solver.advance(solver.time_step_limit());
  for (std::size_t i = 0; i < solver.particles().count; ++i)
    EXPECT_LT(at(solver.particles().v, i).norm(), 1e-9);
}

TEST(AxisymmetricFluid, WeighsWhatItsWholeRingsDo) {
  const WeaklyCompressible solver = closed_vessel().solver();
  const Field& m = solver.particles().m;
  EXPECT_NEAR(std::accumulate(m.begin(), m.begin() + solver.particles().count, 0.0), 1000 * pi * 0.25, 1e-9);
}

TEST(AxisymmetricFluid, FillsABoreAsFarAsItHasWorn) {
  Setting s = closed_vessel();
  for (const double depth : {0.02, 0.08}) {  // rows widen, or there is one more
    s.scene.walls[0].worn = {{.face = Side::lower, .depth = {{-0.2, depth}, {1.2, depth}}}};
    const WeaklyCompressible solver = s.solver();
    const Field& m = solver.particles().m;
    EXPECT_NEAR(std::accumulate(m.begin(), m.begin() + solver.particles().count, 0.0),
                1000 * pi * (0.5 + depth) * (0.5 + depth), 1e-9);
  }
}

Setting colliding_rings() {
  Setting s = about_axis();
  s.parameters.regions = {{"left", {Vec(0, 0), Vec(0.5, 0.4)}, Vec(1.0, 0)},
                          {"right", {Vec(0.5, 0.1), Vec(0.8, 0.6)}, Vec(-1.5, 0)}};
  return s;
}

TEST(AxisymmetricFluid, KeepsItsMomentumAlongTheAxis) {
  WeaklyCompressible solver = colliding_rings().solver();
  const double before = solver.momentum()[0];
  const Vec first = positions(solver).front();
  run_until(solver, 0.03);
  EXPECT_GT((positions(solver).front() - first).norm(), 0.01);
  EXPECT_NEAR(solver.momentum()[0], before, 1e-12 * std::abs(before));
}

/// A tube that repeats itself knows no seam: in each row the medium is alike, beside the axis too.
TEST(AxisymmetricFluid, IsAlikeAllAlongAPeriod) {
  Setting s = about_axis();
  s.parameters.background_pressure = BackgroundPressure{5e4};
  s.scene.domain = {Vec(0, -0.5), Vec(1, 1)};
  s.scene.periodic = Periodic::x;
  s.scene.gravity = Vec(50, 0);
  s.parameters.laminar_viscosity->dynamic_viscosity = 2000;
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.4)}, Vec::Zero()}};
  s.scene.walls = {{"tube", {Vec(0, 0.4), Vec(1, 0.6)}, {}}};
  WeaklyCompressible solver = s.solver();
  for (int step = 0; step < 40; ++step) solver.advance(1e-4);
  const auto v = by_id(solver, solver.particles().v), x = positions(solver);
  std::map<long, Vec> of_row;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto [row, first] = of_row.emplace(std::lround((x[i][1] - 0.025) / 0.05), v[i]);
    EXPECT_LT((v[i] - row->second).norm(), 1e-9) << "at " << x[i].transpose();
  }
  ASSERT_EQ(of_row.size(), 8u);
  EXPECT_NEAR(of_row[0][0], 50 * 4e-3, 1e-3) << "on the axis it still falls freely";
  EXPECT_LT(of_row[7][0], 0.8 * 50 * 4e-3) << "beside the tube it is held back";
}

/// The force along the axis on a fluid that a piston pushes is what its boundaries say.
TEST(AxisymmetricFluid, CountsWhatItsWallsGive) {
  Setting s = closed_vessel();
  s.scene.walls[1].motion = Motion{.velocity = {{0, 0.2, 0}}};
  s.scene.walls[1].name = "piston";
  WeaklyCompressible solver = s.solver();
  run_until(solver, 0.02);
  double given = 0;
  for (const auto& boundary : solver.boundaries()) given += boundary.impulse.total[0];
  EXPECT_GT(std::abs(solver.momentum()[0]), 1);
  EXPECT_NEAR(solver.momentum()[0], given, 1e-11 * std::abs(given));
}

TEST(AxisImages, AreFoundByTheListsOfWhoIsNearTheAxis) {
  const std::vector<Vec> places = {{0, 0.02}, {0.03, 0.1}, {0.05, 0.4}};
  VecField x;
  resize(x, 2 * padded(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k) set(x, k, places[k]);
  for (std::size_t k = places.size(); k < padded(places.size()); ++k) set(x, k, places.back());
  mirror(x);
  const std::size_t first_image = padded(places.size());
  EXPECT_EQ(at(x, first_image + 1), Vec(0.03, -0.1));
  StripOrder strips(1.0);
  strips.index(x[0], places.size());
  ClusterList list;
  const Vec unshifted = Vec::Zero();
  list.build_with_images(x, places.size(), x, strips, 0.15, std::span(&unshifted, 1), first_image);
  ASSERT_EQ(list.near(0).size(), 2);
  EXPECT_THAT(list.near(0)[1].sources, testing::ElementsAre(first_image, first_image + 1));
}

TEST(AxisImages, StandAcrossAPeriodToo) {
  const std::vector<Vec> places = {{0.02, 0.03}, {0.97, 0.04}};
  VecField x;
  resize(x, 2 * padded(places.size()));
  for (std::size_t k = 0; k < padded(places.size()); ++k) set(x, k, places[std::min<std::size_t>(k, 1)]);
  mirror(x);
  const std::size_t first_image = padded(places.size());
  StripOrder strips(1.0);
  strips.index(x[0], places.size());
  const std::vector<Vec> shifts{Vec(0, 0), Vec(-1, 0), Vec(1, 0)};
  ClusterList list;
  list.build_with_images(x, places.size(), x, strips, 0.1, shifts, first_image);
  double found = 0;  // of target 0 and the image of 1, a period away: (0.05, 0.07)
  for (const ShiftedNeighbours& near : list.near(0))
    for (const std::uint32_t j : near.sources)
      if (j == first_image + 1 && (places[0] + near.shift - at(x, j) - Vec(0.05, 0.07)).norm() < 1e-12)
        ++found;
  EXPECT_EQ(found, 1);
}

TEST(AxisImages, MirrorWhatHasADirection) {
  TensorField tensor;
  resize(tensor, 2);
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b) tensor[a][b][0] = 1;
  mirror(tensor);
  EXPECT_EQ(tensor[0][0][1], 1);
  EXPECT_EQ(tensor[0][1][1], -1);
  EXPECT_EQ(tensor[1][0][1], -1);
  EXPECT_EQ(tensor[1][1][1], 1);
}

TEST(AxisFaults, NameWhatIsOfThePlane) {
  Setting s = about_axis();
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.5)}, Vec::Zero()}};
  EXPECT_TRUE(axis_faults(s.parameters, s.scene).empty());
  s.parameters.surface_tension.emplace();
  s.parameters.wall_model.suction = false;
  s.parameters.regions[0].box.min[1] = -0.1;
  std::vector<std::string> keys;
  for (const auto& [key, message] : axis_faults(s.parameters, s.scene)) keys.push_back(key);
  EXPECT_THAT(keys, testing::ElementsAre("fluid.surface_tension", "fluid.wall_model", "fluid.region.0"));
  s.scene.geometry = Geometry::plane;
  EXPECT_TRUE(axis_faults(s.parameters, s.scene).empty());
}

}  // namespace axisymmetry_test
}  // namespace toryu::fluid
