#include "solid_solver/total_lagrangian/laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"
#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

namespace toryu::solid {
namespace {

constexpr double lambda = 3e6, G = 1e6;

template <class AnyLaw>
AnyLaw sample() {
  if constexpr (std::is_same_v<AnyLaw, Yeoh>)
    return {.c_10 = 0.3 * G,
            .c_20 = -0.1 * G,
            .c_30 = 0.04 * G,
            .bulk_modulus = lambda + 2.0 / 3.0 * G,
            .alpha = 0.2 * G,
            .beta = 3.0};
  else
    return {lambda, G};
}

template <class AnyLaw>
class EachLaw : public testing::Test {
 protected:
  const AnyLaw law = sample<AnyLaw>();
};
using Laws = testing::Types<SaintVenantKirchhoff, NeoHookean, Yeoh>;
TYPED_TEST_SUITE(EachLaw, Laws);

TYPED_TEST(EachLaw, ARotationIsNoStrain) {
  for (double angle : {0.1, 1.0, 3.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (double component : this->law.template stress<double>({c - 1, -s, s, c - 1}))
      EXPECT_NEAR(component, 0, 1e-8);
  }
}

TYPED_TEST(EachLaw, StressIsTheSlopeOfTheEnergy) {
  for (const Tensor<double>& H :
       {Tensor<double>{0.2, -0.1, 0.3, -0.15}, Tensor<double>{-0.4, 0.6, 0.1, 0.7}}) {
    const auto P = this->law.stress(H);
    for (std::size_t n = 0; n < 4; ++n) {
      Tensor<double> plus = H, minus = H;
      plus[n] += 1e-6;
      minus[n] -= 1e-6;
      EXPECT_NEAR(P[n], (this->law.energy(plus) - this->law.energy(minus)) / 2e-6, 2e-3);
    }
  }
}

TYPED_TEST(EachLaw, IsHookesLawForSmallStrains) {
  const Tensor<double> H{3e-7, -1e-7, 5e-7, 2e-7};
  const auto P = this->law.stress(H);
  EXPECT_NEAR(P[0], lambda * 5e-7 + 2 * G * 3e-7, 1e-5);
  EXPECT_NEAR(P[1], G * 4e-7, 1e-5);
  EXPECT_NEAR(P[2], G * 4e-7, 1e-5);
  EXPECT_NEAR(P[3], lambda * 5e-7 + 2 * G * 2e-7, 1e-5);
  EXPECT_NEAR(this->law.stress_across(H), lambda * 5e-7, 1e-5);
  const double linear = 0.5 * lambda * 25e-14 + G * (9e-14 + 4e-14 + 2 * 4e-14);
  EXPECT_NEAR(this->law.energy(H) / linear, 1.0, 1e-5);
}

TYPED_TEST(EachLaw, StressAcrossIsThatOfTheOtherUnstretchedDirection) {
  for (double e : {-0.3, 0.4}) {
    const Tensor<double> H{e, 0, 0, 0};  // two of the principal stretches are 1
    EXPECT_NEAR(this->law.stress_across(H), this->law.stress(H)[3], 1e-8);
  }
}

TYPED_TEST(EachLaw, LongitudinalModulusIsTheSlopeOfTheStress) {
  const auto stress = [&](double l) { return this->law.template stress<double>({l - 1, 0, 0, 0.2})[0]; };
  for (double l : {0.6, 1.0, 1.7}) {
    const double slope = (stress(l + 1e-5) - stress(l - 1e-5)) / 2e-5;
    EXPECT_NEAR(this->law.longitudinal_modulus(l * l, 1.44) / slope, 1.0, 1e-7);
  }
}

TYPED_TEST(EachLaw, GivesTheSameInLanes) {
  const Tensor<double> H{0.2, -0.1, 0.3, -0.15};
  const auto numbers = this->law.stress(H);
  const auto lanes = this->law.stress(Tensor<Lanes>{H[0], H[1], H[2], H[3]});
  for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(lanes[n][lane_count - 1], numbers[n], 1e-8);
}

TEST(NeoHookean, StressesByHand) {
  const auto law = sample<NeoHookean>();
  // Stretched to 1.5 with the sides held: 1.5 - 1/1.5 = 5/6, (J^2 - 1)/J = 5/6.
  const auto stretched = law.stress<double>({0.5, 0, 0, 0});
  EXPECT_NEAR(stretched[0], G * 5 / 6 + lambda / 2 * 5 / 6, 1e-8);
  EXPECT_NEAR(stretched[3], lambda / 2 * 1.25, 1e-8);
  // Simple shear keeps the volume: P = G (F - F^-T).
  const auto sheared = law.stress<double>({0, 0.5, 0, 0});
  EXPECT_NEAR(sheared[0], 0, 1e-8);
  EXPECT_NEAR(sheared[1], G * 0.5, 1e-8);
  EXPECT_NEAR(sheared[2], G * 0.5, 1e-8);
  // Both sides by a fifth: J = 1.44.
  EXPECT_NEAR(law.stress<double>({0.2, 0, 0, 0.2})[0],
              G * (1.2 - 1 / 1.2) + lambda / 2 * (1.44 * 1.44 - 1) / 1.2, 1e-8);
}

TEST(Yeoh, StressesByHand) {
  const Yeoh law{.c_10 = 1.0, .c_20 = -0.2, .c_30 = 0.05, .bulk_modulus = 10.0};
  // Simple shear by 0.5: I - 3 = 0.25, psi' = 1 - 0.1 + 0.009375; F^-T has -0.5 at yx.
  const double slope = 0.909375, I_1 = 3.25;
  const auto sheared = law.stress<double>({0, 0.5, 0, 0});
  EXPECT_NEAR(sheared[0], 2 * slope * (1 - I_1 / 3), 1e-14);
  EXPECT_NEAR(sheared[1], 2 * slope * 0.5, 1e-14);
  EXPECT_NEAR(sheared[2], 2 * slope * 0.5 * I_1 / 3, 1e-14);
  EXPECT_NEAR(law.energy({0, 0.5, 0, 0}), 0.25 - 0.2 * 0.0625 + 0.05 * 0.015625, 1e-15);
  // To 8/... of the volume: stretched to 8 with the sides held, J = 8, J^(-2/3) = 1/4, I_1 = 66.
  const double change = 66.0 / 4 - 3, steep = 1 - 0.4 * change + 0.15 * change * change;
  EXPECT_NEAR(law.stress<double>({7, 0, 0, 0})[0], 2 * steep / 4 * (8 - 22.0 / 8) + 5 * 63.0 / 8, 1e-11);
  EXPECT_NEAR(law.stress<double>({7, 0, 0, 0})[3], 2 * steep / 4 * (1 - 22.0) + 5 * 63.0, 1e-11);
}

TEST(Yeoh, FillerStiffensSmallShearOnly) {
  const Yeoh law{.c_10 = 1.0, .bulk_modulus = 10.0, .alpha = 2.0, .beta = std::log(2.0) / 0.25};
  // Simple shear by 0.5: I - 3 = 0.25 halves the filler's share; by 5 nothing of it is left.
  EXPECT_NEAR(law.stress<double>({0, 0.5, 0, 0})[1], 2 * (1 + 2 * 0.5) * 0.5, 1e-14);
  EXPECT_NEAR(law.stress<double>({0, 1e-6, 0, 0})[1], 2 * 3 * 1e-6, 1e-15);
  EXPECT_NEAR(law.stress<double>({0, 5, 0, 0})[1], 2 * 5, 1e-14);
}

TEST(Yeoh, ForSmallStrainsItHasTheModulusOfItsConstants) {
  const ElasticMaterial material = sample<Yeoh>().small_strain(1100);
  EXPECT_NEAR(material.shear_modulus(), G, 1e-6);
  EXPECT_NEAR(material.bulk_modulus(), lambda + 2.0 / 3.0 * G, 1e-6);
  EXPECT_EQ(material.density, 1100);
}

/// A bar of 0.08 x 0.02 m held at one end; a load pulls at the other.
Parameters loaded_bar(ElasticLaw law, bool yeoh, double force) {
  Parameters p = moving_cantilever(4, 0.0);
  p.law = law;
  if (yeoh) {
    p.yeoh = Yeoh{.c_10 = 0.36e6, .c_20 = -0.05e6, .c_30 = 0.1e6, .bulk_modulus = 3.3e6};
    p.material = p.yeoh->small_strain(1000);
  }
  p.loads = {{"end", {Vec(0.06, -1), Vec(1, 1)}, Vec(force, 0)}};
  p.damping = Damping{100};
  p.limits = {.speed = 1e3, .strain = 3.0};
  return p;
}

TEST(TotalLagrangian, TimeStepLimitHoldsForTheStretchedBodyWhateverTheLaw) {
  struct Sample {
    ElasticLaw law;
    bool yeoh;
  };
  for (const auto& [law, yeoh] : {Sample{ElasticLaw::saint_venant_kirchhoff, false},
                                  Sample{ElasticLaw::neo_hookean, false}, Sample{{}, true}}) {
    Parameters p = loaded_bar(law, yeoh, 1.5e4);
    TotalLagrangian model(p, body_of(p), empty_scene());
    const double unloaded = model.time_step_limit();
    EXPECT_NEAR(unloaded * model.find_highest_frequency(), 0.8 * 2.0, 1e-6);
    run_to(model, 0.05);
    model.check(0.05);
    EXPECT_GT(model.displacement(15)[0], 0.012) << "stretched by more than 15 %";
    const double limit = model.time_step_limit();
    std::printf("steps %.3f of the unloaded; %.3f of the exact limit\n", limit / unloaded,
                limit * model.find_highest_frequency() / 1.6);
    EXPECT_LE(limit * model.find_highest_frequency(), 0.8 * 2.0 * 1.001);
  }
}

TEST(TotalLagrangian, StopsWhereAVolumeIsNoLongerPositive) {
  Parameters p = loaded_bar(ElasticLaw::saint_venant_kirchhoff, false, -3e5);
  TotalLagrangian model(p, body_of(p), empty_scene());
  std::string message;
  for (int n = 0; n < 2000 && message.empty(); ++n) try {
      model.advance(1e-5);
      model.check(n * 1e-5);
    } catch (const PhysicsFailure& failure) {
      message = failure.what();
    }
  EXPECT_NE(message.find("volume ratio = -"), std::string::npos) << message;
}

}  // namespace
}  // namespace toryu::solid
