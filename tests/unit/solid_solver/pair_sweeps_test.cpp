#include "solid_solver/updated_lagrangian/pair_sweeps.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "samples.hpp"

namespace toryu::solid {
namespace {

/// Five particles typed by hand; h = 1.
struct Five {
  static constexpr std::size_t count = 5;
  Parameters parameters;
  UpdatedParticles particles;
  ClusterList list;
  StripOrder strips{10.0};

  Five() {
    parameters.formulation = Formulation::updated_lagrangian;
    parameters.material = {.density = 1000, .youngs_modulus = 2e6, .poissons_ratio = 0.4};
    parameters.spacing = 1.0 / 1.3;
    const Vec place[] = {{0.1, 0.0}, {0.2, 0.9}, {0.0, 1.8}, {1.1, 0.2}, {1.0, 1.1}};
    const Vec velocity[] = {{0.3, 0.2}, {-0.1, -0.4}, {0.2, -0.5}, {-0.6, 0.1}, {0.1, 0.3}};
    const std::size_t size = padded(count);
    resize_fields(particles, size);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = std::min(k, count - 1);
      const double a = static_cast<double>(i);
      set(particles.x, k, place[i]);
      set(particles.v, k, velocity[i]);
      particles.m[k] = 3000 + 50 * a;  // heavy, so that few particles make a regular shape tensor
      particles.rho[k] = 1000 + 2 * a;
      particles.V[k] = particles.m[k] / particles.rho[k];
      particles.s.xx[k] = 1e4 * (1 - a);
      particles.s.yy[k] = 5e3 * a;
      particles.s.xy[k] = 2e3 + 1e3 * a;
    }
    strips.index(particles.x[0], count);
    list.build(particles.x, count, particles.x, strips, 2.0);
  }
  double slope_over_r(std::size_t i, std::size_t j) const {
    const double r = (at(particles.x, i) - at(particles.x, j)).norm();
    return CubicSpline(1.0).gradient_over_r(r, 1.0 / r);
  }
  Mat sigma(std::size_t i) const {
    const double p = parameters.material.bulk_modulus() * (particles.rho[i] / 1000 - 1);
    Mat value;
    value << particles.s.xx[i] - p, particles.s.xy[i], particles.s.xy[i], particles.s.yy[i] - p;
    return value;
  }
  Mat L(std::size_t i) const {
    if (parameters.gradients == Gradients::plain) return Mat::Identity();
    Mat M = Mat::Zero();
    for (std::size_t j = 0; j < count; ++j) {
      if (i == j) continue;
      const Vec x_ij = at(particles.x, i) - at(particles.x, j);
      M -= particles.V[j] * slope_over_r(i, j) * x_ij * x_ij.transpose();
    }
    return M.inverse();
  }
  UpdatedRates rates() const {
    UpdatedRates result;
    resize_fields(result, padded(count));
    for (std::size_t c = 0; c < list.clusters(); ++c)
      PairSweeps(parameters).rates(particles, list, c, result);
    return result;
  }
  Vec acceleration(std::size_t i) const {
    const auto a = PairSweeps(parameters).acceleration(particles, rates(), list, i / lane_count);
    return {a[0][i % lane_count], a[1][i % lane_count]};
  }
};

class Gradient : public testing::TestWithParam<Gradients> {};

TEST_P(Gradient, DensityAndStressRatesAreThoseOfTheFormulas) {
  Five five;
  five.parameters.gradients = GetParam();
  const UpdatedRates rates = five.rates();
  const double G = five.parameters.material.shear_modulus();
  for (std::size_t i = 0; i < Five::count; ++i) {
    Mat grad_v = Mat::Zero();
    for (std::size_t j = 0; j < Five::count; ++j) {
      if (i == j) continue;
      const Vec x_ij = at(five.particles.x, i) - at(five.particles.x, j),
                v_ij = at(five.particles.v, i) - at(five.particles.v, j);
      grad_v -= five.particles.V[j] * five.slope_over_r(i, j) * v_ij * (five.L(i) * x_ij).transpose();
    }
    EXPECT_NEAR(rates.rho[i], -five.particles.rho[i] * grad_v.trace(), 1e-9);
    const Mat e = (grad_v + grad_v.transpose()) / 2, omega = (grad_v - grad_v.transpose()) / 2;
    Mat s;
    s << five.particles.s.xx[i], five.particles.s.xy[i], five.particles.s.xy[i], five.particles.s.yy[i];
    const Mat ds = 2 * G * (e - e.trace() / 3 * Mat::Identity()) + s * omega.transpose() + omega * s;
    EXPECT_NEAR(rates.s.xx[i], ds(0, 0), 1e-5);
    EXPECT_NEAR(rates.s.yy[i], ds(1, 1), 1e-5);
    EXPECT_NEAR(rates.s.xy[i], ds(0, 1), 1e-5);
  }
}

TEST_P(Gradient, AccelerationIsThatOfEquation22) {
  Five five;
  five.parameters.gradients = GetParam();
  for (std::size_t i = 0; i < Five::count; ++i) {
    Vec expected = Vec::Zero();
    const auto share = [&](std::size_t k) -> Mat {
      return five.sigma(k) * five.L(k) / (five.particles.rho[k] * five.particles.rho[k]);
    };
    for (std::size_t j = 0; j < Five::count; ++j)
      if (i != j)
        expected += five.particles.m[j] * five.slope_over_r(i, j) * (share(i) + share(j)) *
                    (at(five.particles.x, i) - at(five.particles.x, j));
    EXPECT_NEAR((five.acceleration(i) - expected).norm(), 0, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Gradient, testing::Values(Gradients::plain, Gradients::renormalised),
                         [](const auto& kind) {
                           return kind.param == Gradients::plain ? "plain" : "renormalised";
                         });

TEST(PairSweeps, ViscosityAndArtificialStressAddTheirPairTerms) {
  const Five plain;
  Five full;
  full.parameters.artificial_viscosity = ArtificialViscosity{.alpha = 0.7, .beta = 0.4};
  full.parameters.artificial_stress = ArtificialStress{};
  const auto Pi = pair_viscosity(*full.parameters.artificial_viscosity, full.parameters.material, 1.0);
  const CubicSpline W(1.0);
  const auto R = [&](std::size_t k) -> Mat {
    const Mat sigma = full.sigma(k);
    const auto r = artificial_stress({sigma(0, 0), sigma(1, 1), sigma(0, 1)},
                                     1 / std::pow(full.particles.rho[k], 2), 0.3);
    Mat value;
    value << r.xx[0], r.xy[0], r.xy[0], r.yy[0];
    return value;
  };
  for (std::size_t i = 0; i < Five::count; ++i) {
    Vec expected = Vec::Zero();
    for (std::size_t j = 0; j < Five::count; ++j) {
      if (i == j) continue;
      const Vec x_ij = at(full.particles.x, i) - at(full.particles.x, j),
                v_ij = at(full.particles.v, i) - at(full.particles.v, j);
      const double F = W.value(x_ij.norm()) / W.value(full.parameters.spacing);
      const Mat term =
          (R(i) + R(j)) * std::pow(F, 4) - Pi(v_ij.dot(x_ij), x_ij.squaredNorm())[0] * Mat::Identity();
      expected += full.particles.m[j] * full.slope_over_r(i, j) * term * x_ij;
    }
    EXPECT_NEAR((full.acceleration(i) - plain.acceleration(i) - expected).norm(), 0, 1e-10);
  }
}

TEST(PairSweeps, ALoneParticleKeepsUnitGradients) {
  Five five;
  five.parameters.gradients = Gradients::renormalised;
  for (std::size_t k = 1; k < Five::count; ++k)
    set(five.particles.x, k, at(five.particles.x, k) + Vec(50, 0));
  five.list.build(five.particles.x, Five::count, five.particles.x, five.strips, 2.0);
  EXPECT_EQ(five.rates().rho[0], 0.0);
  EXPECT_EQ(five.acceleration(0), Vec(0, 0));
}

}  // namespace
}  // namespace toryu::solid
