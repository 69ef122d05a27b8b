#include "solid_solver/total_lagrangian/reference_pairs.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "solid_solver/terms/saint_venant_kirchhoff.hpp"

namespace toryu::solid {
namespace reference_pairs_test {

constexpr double h = 1.0;

/// Five particles typed by hand, in strip order, with volumes of their own.
struct Five {
  static constexpr std::size_t count = 5;
  VecField X, u;
  Field volume;
  Five() {
    const Vec place[] = {{0.1, 0.0}, {0.2, 0.9}, {0.0, 1.8}, {1.1, 0.2}, {1.0, 1.1}};
    const Vec displacement[] = {{0.01, 0.02}, {-0.03, 0.0}, {0.02, 0.01}, {0.0, -0.02}, {0.04, 0.03}};
    const double volumes[] = {0.9, 1.0, 1.1, 0.8, 1.2};
    resize(X, padded(count));
    resize(u, padded(count));
    volume.resize(padded(count), 1.2);
    for (std::size_t k = 0; k < padded(count); ++k) {
      set(X, k, place[std::min(k, count - 1)]);
      set(u, k, displacement[std::min(k, count - 1)]);
    }
    for (std::size_t k = 0; k < count; ++k) volume[k] = volumes[k];
  }
  Vec gradW(std::size_t i, std::size_t j) const {
    if (i == j) return Vec::Zero();
    const Vec X_ij = at(X, i) - at(X, j);
    return CubicSpline(h).gradient_over_r(X_ij.norm(), 1.0 / X_ij.norm()) * X_ij;
  }
  /// The formulas of the header, pair by pair.
  Mat L(std::size_t i) const {
    Mat M = Mat::Zero();
    for (std::size_t j = 0; j < count; ++j) M += volume[j] * (at(X, j) - at(X, i)) * gradW(i, j).transpose();
    return M.inverse();
  }
  Mat H(std::size_t i) const {
    Mat sum = Mat::Zero();
    for (std::size_t j = 0; j < count; ++j)
      sum += volume[j] * (at(u, j) - at(u, i)) * (L(i) * gradW(i, j)).transpose();
    return sum;
  }
};

/// One strip wide enough for all.
constexpr double strip_width = 10.0;

TEST(ReferencePairs, DisplacementGradientIsThatOfTheFormula) {
  const Five five;
  const ReferencePairs pairs(five.X, five.volume, Five::count, h, strip_width);
  for (std::size_t i = 0; i < Five::count; ++i) {
    Tensor<Lanes> H;
    pairs.displacement_gradient(five.u, i / lane_count, H);
    const Mat expected = five.H(i);
    for (std::size_t n = 0; n < 4; ++n)
      EXPECT_NEAR(H[n][i % lane_count], expected(static_cast<long>(n / 2), static_cast<long>(n % 2)), 1e-13);
  }
}

TEST(ReferencePairs, ForceIsThatOfTheFormula) {
  const Five five;
  const ReferencePairs pairs(five.X, five.volume, Five::count, h, strip_width);
  Tensor<Field> T;
  resize(T, padded(Five::count));
  const auto tensor = [](std::size_t i) {
    Mat value;
    value << 1.0 + static_cast<double>(i), 2.0, -0.5 * static_cast<double>(i), 3.0;
    return value;
  };
  for (std::size_t i = 0; i < Five::count; ++i)
    for (std::size_t n = 0; n < 4; ++n)
      T[n][i] = tensor(i)(static_cast<long>(n / 2), static_cast<long>(n % 2));
  const double k = 7.0;
  for (std::size_t i = 0; i < Five::count; ++i) {
    Vec expected = Vec::Zero();
    for (std::size_t j = 0; j < Five::count; ++j) {
      if (i == j) continue;
      const double slope_over_R = five.gradW(i, j)[0] / (five.X[0][i] - five.X[0][j]);
      expected += five.volume[j] * ((tensor(i) + tensor(j)) * five.gradW(i, j) +
                                    k * slope_over_R * (at(five.u, i) - at(five.u, j)));
    }
    const VecLanes f = pairs.force_density(five.u, T, k, i / lane_count);
    EXPECT_NEAR(f[0][i % lane_count], expected[0], 1e-12);
    EXPECT_NEAR(f[1][i % lane_count], expected[1], 1e-12);
  }
}

TEST(ReferencePairs, GradientOfALinearDisplacementIsExact) {
  Five five;
  Mat A;
  A << 0.3, -0.2, 0.1, 0.5;
  for (std::size_t k = 0; k < padded(Five::count); ++k) set(five.u, k, A * at(five.X, k));
  const ReferencePairs pairs(five.X, five.volume, Five::count, h, strip_width);
  Tensor<Lanes> H;
  pairs.displacement_gradient(five.u, 0, H);
  EXPECT_NEAR(H[0][0], 0.3, 1e-13);
  EXPECT_NEAR(H[1][0], -0.2, 1e-13);
  EXPECT_NEAR(H[2][0], 0.1, 1e-13);
  EXPECT_NEAR(H[3][0], 0.5, 1e-13);
}

TEST(ReferencePairs, UnseenMotionIsWhatTheGradientLeaves) {
  const Five five;
  const ReferencePairs pairs(five.X, five.volume, Five::count, h, strip_width);
  for (std::size_t i = 0; i < Five::count; ++i) {
    double expected = 0;
    for (std::size_t j = 0; j < Five::count; ++j) {
      if (i == j) continue;
      const Vec unseen = at(five.u, i) - at(five.u, j) - five.H(i) * (at(five.X, i) - at(five.X, j));
      expected -= five.volume[j] * five.gradW(i, j)[0] / (five.X[0][i] - five.X[0][j]) * unseen.squaredNorm();
    }
    Tensor<Lanes> H;
    pairs.displacement_gradient(five.u, i / lane_count, H);
    EXPECT_NEAR(pairs.unseen_motion(five.u, H, i / lane_count)[i % lane_count], expected, 1e-15);
  }
}

/// Four columns of five rows, spacing 1, of which the first two are held: nothing moves at x = 0.
struct HalfHeld {
  static constexpr std::size_t count = 20;
  static constexpr double strip_width = 1.0;  // a column: particles must be numbered in the order of strips
  VecField X, cells, u;
  Field mobile, volume;
  HalfHeld() {
    for (VecField* field : {&X, &cells, &u}) resize(*field, padded(count));
    mobile.resize(padded(count));
    volume.assign(padded(count), 1.0);
    for (std::size_t k = 0; k < padded(count); ++k) {
      const std::size_t n = std::min(k, count - 1);
      set(X, k, Vec(-1.5 + static_cast<double>(n / 5), static_cast<double>(n % 5)));
      set(cells, k, Vec(1, 1));
      mobile[k] = n < 10 ? 0.0 : 1.0;
    }
  }
  ReferencePairs pairs() const { return {X, volume, count, 1.3, strip_width, Held{mobile, cells}}; }
};

TEST(ClampFaces, WhatVanishesAtTheFaceIsSeenExactly) {
  HalfHeld half;
  for (std::size_t k = 0; k < padded(HalfHeld::count); ++k)
    set(half.u, k, half.mobile[k] * half.X[0][k] * Vec(0.01, -0.02));
  const ReferencePairs pairs = half.pairs();
  for (std::size_t i = 10; i < HalfHeld::count; ++i) {
    Tensor<Lanes> H;
    pairs.displacement_gradient(half.u, i / lane_count, H);
    const std::array<double, 4> expected{0.01, 0.0, -0.02, 0.0};
    for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(H[n][i % lane_count], expected[n], 1e-15) << i;
    EXPECT_NEAR(pairs.unseen_motion(half.u, H, i / lane_count)[i % lane_count], 0.0, 1e-15) << i;
  }
}

TEST(ClampFaces, PairsPushEachOtherEquallyAndHeldOnesNotAtAll) {
  HalfHeld half;
  Tensor<Field> T;
  resize(T, padded(HalfHeld::count));
  for (std::size_t k = 0; k < HalfHeld::count; ++k) {
    const double n = static_cast<double>(k);
    set(half.u, k, half.mobile[k] * Vec(0.01 * std::sin(n), 0.02 * std::cos(3 * n)));
    for (std::size_t c = 0; c < 4; ++c) T[c][k] = std::sin(n + static_cast<double>(c));
  }
  const ReferencePairs pairs = half.pairs();
  Vec sum = Vec::Zero(), on_held = Vec::Zero();
  for (std::size_t i = 0; i < HalfHeld::count; ++i) {
    const VecLanes f = pairs.force_density(half.u, T, 7.0, i / lane_count);
    const Vec f_i(f[0][i % lane_count], f[1][i % lane_count]);
    sum += f_i;
    if (i < 10) on_held += f_i;
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-13);
  EXPECT_GT(on_held.norm(), 0.1) << "what the clamp takes is on the held particles";
}

TEST(ClampFaces, LieWhereTheWayEntersTheHeldCells) {
  HalfHeld half;
  half.mobile[9] = 1.0;  // the topmost of the second column is free: the face has a corner
  StripOrder strips(HalfHeld::strip_width);
  strips.index(half.X[0], HalfHeld::count);
  ClusterList list;
  list.build(half.X, HalfHeld::count, half.X, strips, 2.6);
  const ClampFaces faces(half.X, HalfHeld::count, {half.mobile, half.cells}, list, 2.6);
  EXPECT_FALSE(faces.share(10, 15)) << "both are free";
  EXPECT_EQ(faces.share(0, 1), 0.0) << "both are held";
  EXPECT_NEAR(*faces.share(10, 5), 0.5, 1e-8);
  EXPECT_NEAR(*faces.share(10, 0), 0.25, 1e-8) << "half a spacing of two";
  EXPECT_NEAR(*faces.share(0, 10), 0.25, 1e-8) << "the same from the other side";
  EXPECT_NEAR(*faces.share(14, 8), 0.5, 1e-8) << "along the diagonal";
  EXPECT_NEAR(*faces.share(14, 4), 0.75, 1e-8) << "over the free one";
  EXPECT_NEAR(*faces.share(9, 8), 0.5, 1e-8);
}

TEST(SaintVenantKirchhoff, PassesThePatchTests) {
  const double E = 2e6, nu = 0.4, K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu)), eps = 1e-7;
  const SaintVenantKirchhoff law{K - 2 * G / 3, G};
  // Uniaxial tension with free sides in plane strain: eps_yy = -nu/(1 - nu) eps_xx.
  const auto uniaxial = law.stress<double>({eps, 0, 0, -nu / (1 - nu) * eps});
  EXPECT_NEAR(uniaxial[0] / (E / (1 - nu * nu) * eps), 1.0, 1e-6);
  EXPECT_NEAR(uniaxial[3] / (E * eps), 0.0, 1e-6);
  const auto isotropic = law.stress<double>({eps, 0, 0, eps});
  EXPECT_NEAR(isotropic[0] / ((2 * K + 2 * G / 3) * eps), 1.0, 1e-6);
  const auto shear = law.stress<double>({0, eps, 0, 0});
  EXPECT_NEAR(shear[1] / (G * eps), 1.0, 1e-6);
}

}  // namespace reference_pairs_test
}  // namespace toryu::solid
