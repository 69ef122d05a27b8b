// The renormalised density gradient (20)-(21), and the diffusion of a linear density.
#include "fluid_solver/terms/density_gradient.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "fluid_solver/terms/density_diffusion.hpp"
#include "tests/unit/fluid_solver/few_particles.hpp"

namespace toryu::fluid {
namespace density_gradient_test {

constexpr double d_0 = 0.1, h = 1.3 * d_0;
const CubicSpline kernel(h);

/// The first particle is the one looked at.
struct Patch {
  std::vector<Vec> x;
  double volume = d_0 * d_0;
};

/// A lattice of 9 x 9 about the origin, shifted at random by `disorder` spacings.
Patch lattice(double disorder) {
  Patch patch{{Vec::Zero()}};
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return disorder * d_0 * (state / 4294967296.0 - 0.5) * 2;
  };
  for (int a = -4; a <= 4; ++a)
    for (int b = -4; b <= 4; ++b)
      if (a != 0 || b != 0) patch.x.emplace_back(a * d_0 + noise(), b * d_0 + noise());
  return patch;
}

Particles particles_of(const Patch& patch, const std::function<double(const Vec&)>& density) {
  Particles f;
  f.count = patch.x.size();
  resize(f.x, padded(f.count), 1e3);
  for (auto* field : {&f.rho, &f.V}) field->resize(padded(f.count), 1.0);
  for (std::size_t k = 0; k < f.count; ++k) {
    set(f.x, k, patch.x[k]);
    f.rho[k] = density(patch.x[k]);
    f.V[k] = patch.volume;
  }
  return f;
}

Vec gradient(const Patch& patch, const std::function<double(const Vec&)>& density) {
  std::vector<std::uint32_t> all(patch.x.size());
  std::iota(all.begin(), all.end(), 0u);
  const ShiftedNeighbours near{Vec::Zero(), all};
  return first_lane(density_gradient(particles_of(patch, density), kernel, 0, std::span(&near, 1)));
}

const Vec slope(70, -300);
double linear(const Vec& x) {
  return 1000 + slope.dot(x);
}

TEST(DensityGradient, IsExactForLinearDensityInDisorder) {
  EXPECT_LT((gradient(lattice(0.3), linear) - slope).norm(), 1e-12 * slope.norm());
}

TEST(DensityGradient, IsExactAtAFreeSurface) {
  Patch half{{Vec::Zero()}};
  for (const Vec& x : lattice(0.2).x)
    if (x[1] < -0.5 * d_0) half.x.push_back(x);
  for (const double a : {-2 * d_0, -d_0, d_0, 2 * d_0}) half.x.emplace_back(a, 0.0);
  EXPECT_LT((gradient(half, linear) - slope).norm(), 1e-12 * slope.norm());
}

TEST(DensityGradient, NeedsNoRenormalisationInAFullLattice) {
  // sum_j V_j (x_j - x_i) (x) gradW_ij = I but for the error of the sum, L = I
  Vec plain = Vec::Zero();
  const Patch patch = lattice(0);
  for (std::size_t j = 1; j < patch.x.size(); ++j)
    plain += patch.volume * (linear(patch.x[j]) - linear(patch.x[0])) * grad_W(patch.x[0], patch.x[j], h);
  EXPECT_LT((plain - slope).norm(), 0.011 * slope.norm());
  EXPECT_LT((gradient(patch, linear) - plain).norm(), 0.011 * slope.norm());
}

TEST(DensityGradient, IsLeftOutWhereTheMomentIsSingular) {
  const double x = 0.6 * h;
  for (const Patch& poor :
       {Patch{{Vec(0, 0)}}, Patch{{Vec(0, 0), Vec(x, 0)}}, Patch{{Vec(0, 0), Vec(x, 0), Vec(-x, 0)}},
        Patch{{Vec(0, 0), Vec(x, 0.01 * x), Vec(-x, 0.01 * x)}}})
    EXPECT_EQ(gradient(poor, linear), Vec(0, 0)) << poor.x.size() << " particles";
}

TEST(DensityDiffusion, LeavesALinearDensityAloneEvenAtAWall) {
  std::vector<Point> others;
  for (const Vec& x : lattice(0.3).x)
    if (x[1] > -0.5 * d_0 && x.norm() > 0) others.push_back({x, Vec::Zero(), linear(x), 1, 0, slope});
  const Point i{Vec::Zero(), Vec::Zero(), linear(Vec::Zero()), 1, 0, slope};
  const auto rate = [&](const auto& term) {
    return std::abs(sum_over(i, others, kernel, [&](auto&&... a) { term.diffusion(a...); }).diffusion[0]);
  };
  const double plain = rate(DensityDiffusionTerm<false>{1});
  EXPECT_GT(plain, 0);
  EXPECT_LT(rate(DensityDiffusionTerm<true>{1}), 1e-10 * plain);
}

}  // namespace density_gradient_test
}  // namespace toryu::fluid
