// What observers read off particles typed by hand.
#include "fluid_solver/observers.hpp"

#include <gtest/gtest.h>

namespace toryu::fluid {
namespace {

struct Typed {
  Vec x, v;
  double V;
};

Particles particles(const std::vector<Typed>& typed, double rho = 1000) {
  Particles f;
  f.count = typed.size();
  for (auto* field : {&f.x, &f.v}) resize(*field, padded(f.count));
  for (auto* field : {&f.rho, &f.m}) field->assign(padded(f.count), rho);
  for (std::size_t i = 0; i < f.count; ++i) {
    set(f.x, i, typed[i].x);
    set(f.v, i, typed[i].v);
    f.m[i] = rho * typed[i].V;
  }
  return f;
}

TEST(FlowRate, IsCrossSectionTimesTheMeanVelocity) {
  // two particles of 1 x 1 whole in a box 2 wide, a third outside it
  const auto f = particles({{{0.5, 0.5}, {7, 1}, 1}, {{1.5, 0.5}, {7, 4}, 1}, {{0.5, 1.5}, {7, 100}, 1}});
  EXPECT_DOUBLE_EQ(flow_rate(f, {Vec(0, 0), Vec(2, 1)}, Axis::y), 2 * 2.5);
  EXPECT_DOUBLE_EQ(flow_rate(f, {Vec(0, 0), Vec(2, 1)}, Axis::x), 1 * 7);
}

TEST(FlowRate, WeighsAParticleByItsShareInTheBox) {
  // one fourth of the first lies in the box (half of it in each direction), and the whole of the second,
  // whose volume is 4: (0.25 * 8 + 4 * 2)/(4.25) times the width 4
  const auto f = particles({{{0, 0}, {0, 8}, 1}, {{2, 2}, {0, 2}, 4}});
  EXPECT_DOUBLE_EQ(flow_rate(f, {Vec(0, 0), Vec(4, 4)}, Axis::y), 4 * 10 / 4.25);
}

TEST(FlowRate, IsZeroWhereThereIsNoFluid) {
  EXPECT_EQ(flow_rate(particles({{{9, 9}, {1, 1}, 1}}), {Vec(0, 0), Vec(1, 1)}, Axis::x), 0);
}

TEST(VolumeFlux, IsOfWhatIsInTheBoxHoweverMuchItFills) {
  // a row of two particles of 1 x 1 in a box 2 long and 5 wide, a third outside it
  const auto f = particles({{{0.5, 0.5}, {7, 1}, 1}, {{1.5, 0.5}, {5, 4}, 1}, {{0.5, 9}, {7, 100}, 1}});
  EXPECT_DOUBLE_EQ(volume_flux(f, {Vec(0, -2), Vec(2, 3)}, Axis::x), 1 * 6);
}

TEST(PressureProbe, IsTheKernelMean) {
  // one particle at the probe, one at distance h: W(1)/W(0) = 1/4 by (11)
  const CubicSpline kernel(0.5);
  const EquationOfState state{1000, 10, 1};
  auto f = particles({{{0, 0}, {0, 0}, 1}, {{0.5, 0}, {0, 0}, 1}});
  f.rho[1] = 1010;  // 1000 Pa by (3) with gamma = 1
  Scene scene;
  scene.domain = {Vec(-2, -2), Vec(8, 8)};
  const Period nowhere(scene, 1, 1);
  EXPECT_NEAR(pressure_at(Vec(0, 0), f, kernel, state, nowhere), 0.25 * 1000 / 1.25, 1e-9);
  EXPECT_EQ(pressure_at(Vec(10, 0), f, kernel, state, nowhere), 0);
  scene.periodic = Periodic::x;
  EXPECT_NEAR(pressure_at(Vec(10, 0), f, kernel, state, Period(scene, 1, 1)), 0.25 * 1000 / 1.25, 1e-9);
}

TEST(FlowAmplitude, IsTheShareOfTheInitialFlow) {
  const InitialFlow flow{FlowProfile::strain, 2, 1, 0, Vec(0, 0)};  // v_0 = (2 x, -2 y)
  const auto f = particles({{{1, 0}, {1, 5}, 1}, {{0, 2}, {7, -1}, 3}});
  EXPECT_DOUBLE_EQ(flow_amplitude(f, flow), (1 * 2 + 3 * 4) / (1 * 4.0 + 3 * 16.0));
  // against half of v_0: differences (0, 5), (7, 1)
  EXPECT_DOUBLE_EQ(flow_error(f, flow, 0.5), std::sqrt((25 + 50) / 2.0) / 2);
}

TEST(LargestVoid, IsFarthestFromAnyParticle) {
  // corners of a square of side 1, spacing 1: 0.5 sqrt 2 from its middle; a wall particle there leaves 0.5
  const Vec rest(0, 0);
  const auto f = particles({{{0, 0}, rest, 1}, {{1, 0}, rest, 1}, {{0, 1}, rest, 1}, {{1, 1}, rest, 1}});
  const Box square{Vec(0, 0), Vec(1, 1)};
  Scene scene;
  scene.domain = {Vec(-1, -1), Vec(7, 7)};
  const Period nowhere(scene, 1, 1);
  EXPECT_NEAR(largest_void(f, {}, square, 1, nowhere), std::sqrt(0.5), 1e-12);
  std::vector<Boundary> walls(1);
  walls[0].place({Vec(0.5, 0.5)}, {1}, 1000, 1);
  EXPECT_NEAR(largest_void(f, walls, square, 1, nowhere), 0.5, 1e-12);
  // 2.2 is 1.2 away; no farther than 2 is looked
  EXPECT_NEAR(largest_void(f, {}, {Vec(0, 0), Vec(2.2, 0)}, 1, nowhere), 1.2, 1e-12);
  EXPECT_NEAR(largest_void(f, {}, {Vec(0, 0), Vec(6, 0)}, 1, nowhere), 2, 1e-12);
  // across the seam: the square's image at x = 8
  scene.periodic = Periodic::x;
  EXPECT_NEAR(largest_void(f, {}, {Vec(6.5, 0), Vec(7, 0)}, 1, Period(scene, 1, 1)), 1.5, 1e-12);
}

TEST(Front, IsHalfASpacingBeyondTheForemostParticle) {
  EXPECT_DOUBLE_EQ(front_x(particles({{{3, 0}, {0, 0}, 1}, {{1, 5}, {0, 0}, 1}}), 0.5), 3.25);
}

}  // namespace
}  // namespace toryu::fluid
