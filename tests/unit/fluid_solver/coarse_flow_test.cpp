// The grid of the implicit model's preconditioner, by fields whose answer is known by hand.
#include "fluid_solver/implicit/coarse_flow.hpp"

#include <gtest/gtest.h>

namespace toryu::fluid {
namespace {

constexpr Eigen::Index across = 12, count = across * 7;

/// Particles on a lattice that is a little bent, of unlike masses.
struct Lattice {
  Lattice() {
    for (auto& component : x) component.resize(count);
    m.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double column = static_cast<double>(i % across), row = static_cast<double>(i / across);
      set(x, i, Vec(3 + 0.1 * column + 0.01 * row, -1 + 0.1 * row));
      m[i] = 0.01 + 0.001 * static_cast<double>(i % 5);
    }
  }
  CoarseFlow flow(double viscous, double compressive) const {
    CoarseFlow flow(x, count, 0.25);
    for (std::size_t i = 0; i < count; ++i) flow.add(at(x, i), m[i], viscous, compressive);
    return flow;
  }
  /// (a x + b, c y + d) of all.
  CoarseFlow::Vector linear(double a, double b, double c, double d) const {
    CoarseFlow::Vector r(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      r[k] = a * x[0][i] + b;
      r[count + k] = c * x[1][i] + d;
    }
    return r;
  }
  VecField x;
  Field m;
};

TEST(CoarseFlow, PaysWhereTheMediumIsNotScattered) {
  const VecField square{Field{0, 1, 0, 1}, Field{0, 0, 1, 1}},
      scattered{Field{0, 1, 9, 10}, Field{0, 1, 9, 10}};
  EXPECT_TRUE(CoarseFlow::pays(square, 4, 1));
  EXPECT_FALSE(CoarseFlow::pays(scattered, 4, 1));
}

TEST(CoarseFlow, GivesBackLinearVelocitiesOfMassAlone) {
  const Lattice lattice;
  CoarseFlow flow = lattice.flow(0, 0);
  flow.factorise();
  const auto r = lattice.linear(2, -1, 0.5, 3);
  EXPECT_LT((flow.correction(lattice.x, lattice.m, r) - r).norm(), 1e-7 * r.norm());
}

TEST(CoarseFlow, LeavesTheMeanWhereTheMediumIsStiffAndWallsHoldIt) {
  const Lattice lattice;
  CoarseFlow flow = lattice.flow(1e6, 0);
  double mass = 0, momentum = 0;
  const auto r = lattice.linear(2, -1, 0, 0);
  for (std::size_t i = 0; i < count; ++i)
    mass += lattice.m[i], momentum += lattice.m[i] * r[static_cast<Eigen::Index>(i)];
  flow.hold(Vec(3.42, -0.66), 0.7);
  flow.hold(Vec(2.0, -0.95), 100);  // out of reach
  flow.factorise();
  const auto v = flow.correction(lattice.x, lattice.m, r);
  for (Eigen::Index i = 0; i < count; ++i) {
    EXPECT_NEAR(v[i], momentum / (mass + 0.7), 1e-4);
    EXPECT_NEAR(v[count + i], 0, 1e-4);
  }
}

TEST(CoarseFlow, KeepsWhatDoesNotCompressAndNothingElse) {
  const Lattice lattice;
  CoarseFlow flow = lattice.flow(0, 1e4);
  flow.factorise();
  const auto shear = lattice.linear(1, 0, -1, 0), growth = lattice.linear(1, -3.55, 1, 0.7);
  EXPECT_LT((flow.correction(lattice.x, lattice.m, shear) - shear).norm(), 1e-5 * shear.norm());
  const auto left = flow.correction(lattice.x, lattice.m, growth);  // compresses no more
  EXPECT_LT(left.norm(), 0.6 * growth.norm());
  EXPECT_LT((flow.correction(lattice.x, lattice.m, left) - left).norm(), 1e-3 * left.norm());
}

// One mass in all: of the medium, which hardly gives way, of a piston of 0.5 kg on it, and of the row of the
// system that says as much as 0.2 kg.
TEST(CoarseFlow, MovesAPistonWithTheMediumThatItHolds) {
  const Lattice lattice;
  CoarseFlow flow(lattice.x, count, 0.25, {{0.5, 0.2}});
  double mass = 0;
  for (std::size_t i = 0; i < count; ++i) {
    flow.add(at(lattice.x, i), lattice.m[i], 1e6, 0);
    mass += lattice.m[i];
  }
  flow.hold(Vec(3.42, -0.66), 1e5, 0, -Vec::UnitX());
  flow.hold(Vec(2.0, -0.95), 30, 0, -Vec::UnitX());  // out of reach
  flow.factorise();
  CoarseFlow::Vector r = CoarseFlow::Vector::Zero(2 * count + 1);
  r[2 * count] = 3;
  const auto v = flow.correction(lattice.x, lattice.m, r);
  EXPECT_NEAR(v[2 * count], 0.2 * 3 / (mass + 0.5), 1e-4);
  for (Eigen::Index i = 0; i < count; ++i) {
    EXPECT_NEAR(v[i], -v[2 * count], 1e-4);
    EXPECT_NEAR(v[count + i], 0, 1e-4);
  }
}

}  // namespace
}  // namespace toryu::fluid
