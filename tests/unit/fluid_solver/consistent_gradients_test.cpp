// Rates that are exact in linear fields, however the particles lie.
#include "fluid_solver/weakly_compressible/consistent_gradients.hpp"

#include <gtest/gtest.h>

#include "fluid_solver/neighbours.hpp"
#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

constexpr double d_0 = 0.05, rho = 1000, mu = 3;
const WendlandC2 kernel(1.5 * d_0);

struct Fields {
  std::function<Vec(const Vec&)> v;
  std::function<double(const Vec&)> p;
};

/// A disordered block with these fields, whose rates are the sums of (18), (22) and of laminar viscosity.
struct Block {
  explicit Block(const Fields& fields) {
    Setting s = empty_space();
    s.parameters.start_disorder = 0.2;
    s.parameters.regions = {{"block", {Vec(0, 0), Vec(0.6, 0.6)}}};
    fluid = s.solver().particles();
    std::vector<Boundary> none;
    lists.build(fluid, none, 0);
    for (std::size_t i = 0; i < fluid.count; ++i) {
      const Vec x = at(fluid.x, i);
      set(fluid.v, i, fields.v(x));
      fluid.p[i] = fields.p(x);
      fluid.p_rho2[i] = fluid.p[i] / (rho * rho);
      fluid.V[i] = d_0 * d_0;
    }
    fluid.off_surface_and_walls.assign(padded(fluid.count), 1.0);
    for (std::size_t i = 0; i < fluid.count; ++i) sum_plainly(i);
  }
  void sum_plainly(std::size_t i) {
    Vec a = Vec::Zero();
    double drho = 0;
    for (std::size_t j = 0; j < fluid.count; ++j) {
      const Vec x_ij = at(fluid.x, i) - at(fluid.x, j), v_ij = at(fluid.v, i) - at(fluid.v, j);
      const double r = x_ij.norm();
      if (i == j || r >= kernel.support()) continue;
      const double G = kernel.gradient_over_r(r, 1 / r), V = d_0 * d_0, m = rho * V;
      drho += rho * V * G * v_ij.dot(x_ij);
      a -= m * (fluid.p_rho2[i] + fluid.p_rho2[j]) * G * x_ij;
      a += m * 2 * mu / (rho * rho) * G * v_ij;
    }
    set(fluid.a, i, a);
    fluid.drho[i] = drho;
  }
  /// The particle next to the middle, all of whose neighbours are there.
  std::size_t middle() const {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < fluid.count; ++i)
      if ((at(fluid.x, i) - Vec(0.3, 0.3)).norm() < (at(fluid.x, nearest) - Vec(0.3, 0.3)).norm())
        nearest = i;
    return nearest;
  }
  Particles fluid;
  Neighbours lists{kernel.support(), 0.1 * kernel.support(), 0.1, {Vec::Zero()}};
};

const Vec slope(70, -300);
const Fields linear{[](const Vec& x) { return Vec(2 * x[0] - x[1], 0.5 * x[0] + 3 * x[1]); },
                    [](const Vec& x) { return 1e3 + slope.dot(x); }};

TEST(ConsistentGradients, AreExactInLinearFields) {
  Block block(linear);
  const std::size_t i = block.middle();
  EXPECT_GT(std::abs(block.fluid.drho[i] + 5 * rho), 0.01 * rho);  // which the plain sums are not
  EXPECT_GT((at(block.fluid.a, i) + slope / rho).norm(), 0.1 * slope.norm() / rho);
  make_gradients_consistent(RatesOf::both, mu, block.fluid, block.lists.of_fluid(), kernel);
  EXPECT_NEAR(block.fluid.drho[i], -5 * rho, 1e-9 * rho);
  EXPECT_LT((at(block.fluid.a, i) + slope / rho).norm(), 1e-9 * slope.norm() / rho);
}

TEST(ConsistentGradients, GiveTheViscousForceOfACurvedVelocity) {
  // laplacian of (x^2 + y^2, -3 y^2) is (4, -6)
  Block block(
      {[](const Vec& x) { return Vec(x.squaredNorm(), -3 * x[1] * x[1]); }, [](const Vec&) { return 0.0; }});
  const std::size_t i = block.middle();
  const Vec exact = mu / rho * Vec(4, -6);
  const double plain = (at(block.fluid.a, i) - exact).norm() / exact.norm();
  make_gradients_consistent(RatesOf::velocity, mu, block.fluid, block.lists.of_fluid(), kernel);
  const double consistent = (at(block.fluid.a, i) - exact).norm() / exact.norm();
  EXPECT_GT(plain, 0.1);
  EXPECT_LT(consistent, 0.1);
}

TEST(ConsistentGradients, LeaveAloneWhatIsNotAskedFor) {
  Block block(linear);
  const std::size_t i = block.middle();
  const Particles before = block.fluid;
  block.fluid.off_surface_and_walls[i] = 0;
  make_gradients_consistent(RatesOf::density, mu, block.fluid, block.lists.of_fluid(), kernel);
  EXPECT_EQ(block.fluid.drho[i], before.drho[i]);  // with a free surface in reach
  EXPECT_EQ(block.fluid.a, before.a);
  EXPECT_NE(block.fluid.drho, before.drho);
}

}  // namespace
}  // namespace toryu::fluid
