/// What the coupling schemes are made of: the extrapolation of the motion, the steps of the iteration.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "coupler/acceleration.hpp"
#include "coupler/added_mass.hpp"
#include "coupler/extrapolation.hpp"

namespace toryu::coupling {
namespace {

/// One particle that moves along x: position, velocity.
InterfaceMotion one(double x, double v) {
  return {{x, 0}, {v, 0}};
}

TEST(Extrapolation, FollowsOneWindowLateAtOrderZero) {
  Extrapolation extrapolation(0, one(1, 4));
  EXPECT_EQ(extrapolation.over(0.5).position[0], 1);
  EXPECT_EQ(extrapolation.over(0.5).velocity[0], 4);
  extrapolation.note(one(3, 4), 0.5);
  EXPECT_EQ(extrapolation.over(0.5).position[0], 3);
  // The first window was 0.5 s: in one of 0.25 s the copy goes on at the same speed, to where the solid was
  // 0.5 s before the end of that one.
  EXPECT_EQ(extrapolation.over(0.25).position[0], 2);
  EXPECT_EQ(extrapolation.over(0.75).position[0], 4);
}

TEST(Extrapolation, GoesOnWithTheVelocityAtOrderOne) {
  Extrapolation extrapolation(1, one(1, 4));
  EXPECT_EQ(extrapolation.over(0.5).position[0], 3);
  EXPECT_EQ(extrapolation.over(0.5).velocity[0], 4);
}

TEST(Extrapolation, GoesOnWithTheAccelerationAtOrderTwo) {
  Extrapolation extrapolation(2, one(0, 0));
  EXPECT_EQ(extrapolation.over(0.5).position[0], 0);  // nothing is known of an acceleration yet
  extrapolation.note(one(0.25, 1), 0.5);              // x = t^2
  EXPECT_EQ(extrapolation.over(1.0).position[0], 2.25);
  EXPECT_EQ(extrapolation.over(1.0).velocity[0], 2);  // the mean of the way
}

/// A linear answer x~ = J x + b to a guess x.
struct Answer {
  Eigen::MatrixXd J;
  Values b;
  Values residual(const Values& x) const { return J * x + b - x; }
};

/// Iterates from 0; returns how many steps bring the residual below 1e-7.
int steps(Acceleration& acceleration, const Answer& answer, int most = 50) {
  acceleration.begin_window();
  Values x = Values::Zero(answer.b.size());
  for (int k = 0; k < most; ++k) {
    const Values r = answer.residual(x);
    if (r.norm() < 1e-7) return k;
    x = acceleration.next(x, r);
  }
  return most;
}

/// An added mass of g times the solid's own: the answer turns a guess round, g times as far.
Answer added_mass(double g) {
  return {Eigen::MatrixXd::Constant(1, 1, -g), Values::Constant(1, 3.0)};
}

TEST(FixedRelaxation, ConvergesOnlyWithASmallFactor) {
  FixedRelaxation whole(1.0), tenth(0.1);
  EXPECT_EQ(steps(whole, added_mass(1.5)), 50);
  EXPECT_LT(steps(tenth, added_mass(9)), 3);  // 1 - 0.1 (1 + 9) = 0
  EXPECT_EQ(steps(tenth, added_mass(30)), 50);
}

TEST(Aitken, FindsTheFactorOfASingleModeInTwoSteps) {
  AitkenRelaxation aitken(0.5);
  EXPECT_EQ(steps(aitken, added_mass(9)), 2);
  EXPECT_NEAR(aitken.factor(), 0.1, 1e-12);    // 1/(1 + 9)
  EXPECT_EQ(steps(aitken, added_mass(9)), 1);  // which the next window starts with
}

/// Three modes of different added mass, mixed.
Answer three_modes() {
  Eigen::Matrix3d mix;
  mix << 1, 2, 0, 0, 1, 3, 1, 0, 1;
  const Eigen::Matrix3d gains = Eigen::Vector3d(-8, -3, -0.5).asDiagonal();
  return {mix * gains * mix.inverse(), Values(Eigen::Vector3d(1, 2, 3))};
}

TEST(QuasiNewton, SolvesAsManyModesAsItHasDifferences) {
  QuasiNewton quasi_newton(0.5, 0);
  EXPECT_EQ(steps(quasi_newton, three_modes()), 4);  // one fixed step, three differences
  AitkenRelaxation aitken(0.5);
  EXPECT_GT(steps(aitken, three_modes()), 8);
}

TEST(QuasiNewton, RemembersEarlierWindows) {
  QuasiNewton quasi_newton(0.5, 1);
  EXPECT_EQ(steps(quasi_newton, three_modes()), 4);
  Answer next = three_modes();
  next.b = Values(Eigen::Vector3d(-1, 5, 2));
  EXPECT_EQ(steps(quasi_newton, next), 1);
  EXPECT_EQ(quasi_newton.rank(), 3);
}

TEST(QuasiNewton, FiltersColumnsThatSayTheSame) {
  QuasiNewton quasi_newton(0.5, 0);
  quasi_newton.begin_window();
  const Values x = Values::Zero(3), r = Eigen::Vector3d(4, 4, 4);
  quasi_newton.next(x, r);
  quasi_newton.next(x, 0.5 * r);
  const Values next = quasi_newton.next(x, 0.25 * r);  // a second difference along the first
  EXPECT_EQ(quasi_newton.rank(), 1);
  EXPECT_TRUE(next.allFinite());
}

/// Three rows of a plate, 3 kg/m each, with water above, whose kernel reaches two of them. The upper one is
/// behind 0.02 m of surface, as the lower one is.
struct PlateUnderWater {
  FluidTraits water{.reach = 0.045, .density = 1000, .sound_speed = 20, .spacing = 0.01};
  Interface plate{.id = {0, 1, 2},
                  .position = {0, -0.01, 0, -0.03, 0, -0.05},
                  .volume = {4e-4, 4e-4, 4e-4},
                  .area_vector = {0, 0.02, 0, 0, 0, -0.02},
                  .mass = {3, 3, 3},
                  .spacing = 0.02};
  /// Water of which every row bears a part, or the upper alone; its pressure above, its forces on the rows.
  std::optional<double> under(double pressure, double upper, double middle, double lower) const {
    return SurfaceLayer(plate, water).mass_ratio({{pressure, 0, 0}, {0, upper, 0, middle, 0, lower}, {}, {}});
  }
};

TEST(AddedMass, IsWeighedAgainstARowOfFluid) {
  const PlateUnderWater scene;
  EXPECT_DOUBLE_EQ(*scene.under(5, -4, -1, 0), 30);  // 600 kg/m2; dry below
  EXPECT_DOUBLE_EQ(*scene.under(5, -4, -1, -1), 30) << "a kernel that sees through the plate pulls below";
  EXPECT_DOUBLE_EQ(*scene.under(-5, 4, 1, 0), 30) << "water above that sucks";
  EXPECT_FALSE(scene.under(0, 0, 0, 0));
}

TEST(AddedMass, CountsOnceWhatLiesBehindTwoWetFaces) {
  const PlateUnderWater scene;
  EXPECT_DOUBLE_EQ(*scene.under(5, -4, 0, 4), 22.5);  // 9 kg/m behind 0.04 m
}

TEST(AddedMass, IsThatOfTheWholeLayerWhereWaterOnlyGrazesTheSolid) {
  const PlateUnderWater scene;
  EXPECT_DOUBLE_EQ(*scene.under(0.1, -1e-3, 0, 0), 30);
}

TEST(AddedMass, IsOfNoMoreThanFluidBesideTheSolidHasInReach) {
  PlateUnderWater scene;
  scene.water.reach = 0.034;  // 1 mm short of the second row, from water half a spacing off
  EXPECT_DOUBLE_EQ(*scene.under(5, -4, -1, 0), 15);
  scene.water.reach = 0.2;
  EXPECT_DOUBLE_EQ(*scene.under(5, -4, -1, 0), 45);
}

TEST(AddedMass, IsOfWhatLiesBehindTheFaceAndNotBeside) {
  PlateUnderWater scene;
  scene.plate.position = {0, -0.01, 0.02, -0.03, 0, 0.01};
  EXPECT_DOUBLE_EQ(*scene.under(5, -4, -1, 0), 15);
}

TEST(AddedMass, HasALimitByScheme) {
  FluidTraits water{.density = 1000, .sound_speed = 20, .spacing = 0.01};
  EXPECT_DOUBLE_EQ(least_mass_ratio(SchemeKind::serial_explicit, SolidKind::elastic, water, 1e-4), 0.37);
  EXPECT_DOUBLE_EQ(least_mass_ratio(SchemeKind::serial_explicit, SolidKind::elastic, water, 1e-3),
                   1);  // C = 2
  EXPECT_DOUBLE_EQ(least_mass_ratio(SchemeKind::parallel_explicit, SolidKind::elastic, water, 1e-4), 0.9);
  EXPECT_DOUBLE_EQ(least_mass_ratio(SchemeKind::serial_robin, SolidKind::elastic, water, 1e-3), 0.03);
  EXPECT_EQ(least_mass_ratio(SchemeKind::serial_implicit, SolidKind::elastic, water, 1e-3), 0);
  EXPECT_EQ(least_mass_ratio(SchemeKind::serial_robin, SolidKind::rigid, water, 1e-3), 0);
  EXPECT_DOUBLE_EQ(least_mass_ratio(SchemeKind::serial_explicit, SolidKind::rigid, water, 1e-4), 0.37);
  EXPECT_EQ(least_mass_ratio(SchemeKind::parallel_explicit, SolidKind::held, water, 1e-4), 0);
  water.reach = 0.05;  // twice as far as that with which they were measured
  EXPECT_DOUBLE_EQ(least_mass_ratio(SchemeKind::parallel_explicit, SolidKind::elastic, water, 1e-4), 1.8);
}

}  // namespace
}  // namespace toryu::coupling
