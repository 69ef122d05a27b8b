// The grid of the implicit model's preconditioner, by fields whose answer is known by hand.
#include "fluid_solver/implicit/coarse_flow.hpp"

#include <gtest/gtest.h>

#include "fluid_solver/implicit/implicit.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

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

/// Row i of the lattice beside the image of row 6 - i, whatever the cells: 0.6 m are 2.4 of them.
TEST(CoarseFlow, IsItsOwnImage) {
  Lattice lattice;
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = i / across, image = 6 - row;
    lattice.x[0][i] = 3 + 0.1 * static_cast<double>(i % across);
    lattice.m[i] = 0.01 + 0.001 * static_cast<double>(std::min(row, image));
  }
  CoarseFlow flow = lattice.flow(0.02, 0.5);
  flow.hold(Vec(3, -1.05), 0.1);
  flow.hold(Vec(3, -0.35), 0.1);
  flow.factorise();
  CoarseFlow::Vector r(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = i / across, image = 6 - row;
    r[i] = std::sin(static_cast<double>(i % across)) + static_cast<double>(row * image);
    r[count + i] = static_cast<double>((row - image) * (i % across));
  }
  const auto found = flow.correction(lattice.x, lattice.m, r);
  EXPECT_GT(found.norm(), 0.1 * r.norm());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index image = (6 - i / across) * across + i % across;
    EXPECT_NEAR(found[i], found[image], 1e-12 * found.norm());
    EXPECT_NEAR(found[count + i], -found[count + image], 1e-12 * found.norm());
  }
}

/// A no-slip slit 0.5 m wide about y = 0.25 m, whose pistons move as prescribed.
Setting driven_slit() {
  const Motion motion{.velocity = {{0.0, 0.0, 0.0}, {0.05, 0.3, 0.0}}};
  Setting s = space_of_implicit_steps();
  s.parameters.kernel = KernelForm::wendland_c2;
  s.parameters.smoothing_ratio = 2;
  s.parameters.background_pressure = BackgroundPressure{1e5};
  s.parameters.regions = {{"medium", {Vec(0, 0), Vec(1, 0.5)}, Vec::Zero()}};
  s.scene.walls = {{"lower", {Vec(-0.3, -0.2), Vec(1.5, 0)}, {}},
                   {"upper", {Vec(-0.3, 0.5), Vec(1.5, 0.7)}, {}},
                   {"left", {Vec(-0.2, 0), Vec(0, 0.5)}, motion},
                   {"right", {Vec(1, 0), Vec(1.2, 0.5)}, motion}};
  return s;
}

// What the tolerance leaves unsolved must not tell the halves of a slit apart: particles in a shear part from
// each other exponentially, and do so from any difference.
TEST(CoarseFlow, LeavesTheHalvesOfASlitAlike) {
  const Setting s = driven_slit();
  Implicit model(s.parameters, s.scene);
  const Particles& f = model.particles();
  const auto by_number = [&](const VecField& field) {
    std::vector<Vec> values(f.count);
    for (std::size_t k = 0; k < f.count; ++k) values[f.id[k]] = at(field, k);
    return values;
  };
  const auto start = by_number(f.x);
  for (int n = 0; n < 10; ++n) model.advance(0.02);
  const auto x = by_number(f.x);
  const auto image = [](const Vec& place) { return Vec(place[0], 0.5 - place[1]); };
  double largest = 0, moved = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) {
      if ((image(start[i]) - start[j]).norm() > 1e-9) continue;
      largest = std::max(largest, (image(x[i]) - x[j]).norm());
      moved = std::max(moved, (x[i] - start[i]).norm());
    }
  EXPECT_GT(moved, 0.05);
  EXPECT_LT(largest, 1e-12);
}

}  // namespace
}  // namespace toryu::fluid
