/// Bodies of several materials against exact solutions: layers behind and beside each other, a bonded beam,
/// and the natural frequency of a bar of two halves.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "solid_case.hpp"

namespace toryu::solid {
namespace {

/// Run until it rests, `time` [s]; what the observers say then.
std::unique_ptr<SolidModel> at_rest(const std::string& file, std::vector<std::string> overrides,
                                    double time = 1.0) {
  auto model = solid_case("bonded_beam/" + file, overrides);
  run_to(*model, time);
  return model;
}

TEST(BondedBeam, LayersBehindEachOtherStretchAsTheirStiffnessesInARow) {
  // u(0.7) = p (0.4/E_1 + 0.3/E_2). What is lacking is a tenth of a spacing of the softer, for any contrast.
  for (const double contrast : {10.0, 1000.0}) {
    std::vector<double> errors;
    for (const double spacing : {0.02, 0.01}) {
      const auto model = at_rest("layered_bar.toml",
                                 {fmt::format("solid.spacing={}", spacing),
                                  fmt::format("solid.material.stiff.youngs_modulus={}", 1e6 * contrast)},
                                 contrast > 100 ? 0.3 : 1.0);
      const double exact = 100 * (0.4 / 1e6 + 0.3 / (1e6 * contrast));
      errors.push_back((observed(*model, "outer_displacement_x") - exact) / (1e-4 * spacing));
      std::printf("contrast %g, spacing %g m: %+.3f spacings, %+.3f %%\n", contrast, spacing, errors.back(),
                  1e-2 * errors.back() * spacing / exact);
    }
    EXPECT_NEAR(errors[1], -0.1, 0.05);
    EXPECT_NEAR(errors[1], errors[0], 0.05) << "of first order";
  }
}

TEST(BondedBeam, LayersSideBySideShareTheForceByTheirStiffness) {
  const auto model = at_rest("side_by_side.toml", {});
  const double exact = 40 * 0.4 / (0.04 * 1e6 + 0.04 * 1e7);
  const double stretch = observed(*model, "outer_displacement_x") - observed(*model, "inner_displacement_x");
  std::printf("stretch %+.3f %%\n", 100 * (stretch / exact - 1));
  EXPECT_NEAR(stretch, exact, 2e-3 * exact);
}

TEST(BondedBeam, BendsByTheStiffnessOfItsTransformedSection) {
  // 1.2833 mm by biquadratic finite elements, 16 across; 1.2883 mm by Timoshenko's beam.
  const auto model = at_rest("case.toml", {"solid.spacing=0.005"}, 0.8);
  const double deflection = observed(*model, "end_displacement_y");
  std::printf("deflection %.5f mm, %+.2f %%\n", 1e3 * deflection, 100 * (deflection / 1.2833e-3 - 1));
  EXPECT_NEAR(deflection, 1.2833e-3, 0.05 * 1.2833e-3);
}

/// The first angular frequency of the bar that is held at one end [1/s]: tan a tan b = Z_1/Z_2.
double exact_frequency() {
  const double c_1 = std::sqrt(1e6 / 1000), c_2 = std::sqrt(1e7 / 2500), Z = (1000 * c_1) / (2500 * c_2);
  double low = 1, high = 0.5 * std::numbers::pi * c_1 / 0.4;
  for (int n = 0; n < 60; ++n) {
    const double omega = 0.5 * (low + high);
    (std::tan(0.4 * omega / c_1) * std::tan(0.4 * omega / c_2) < Z ? low : high) = omega;
  }
  return low;
}

TEST(BondedBeam, SwingsAtTheFrequencyOfABarOfTwoHalves) {
  for (const double spacing : {0.02, 0.01}) {
    const auto model = solid_case(
        "bonded_beam/layered_bar.toml",
        {fmt::format("solid.spacing={}", spacing), "solid.damping=false", "solid.load.pull.force=[0,0]",
         "solid.initial_velocity={profile=\"linear\",velocity=[0,0],gradient=[[0.01,0],[0,0]]}"});
    // The frequency at which the end's motion, under a window of ten periods, has most.
    const double omega = exact_frequency(), length = 10 * 2 * std::numbers::pi / omega;
    std::vector<std::pair<double, double>> motion;
    const double dt = 0.9 * model->time_step_limit();
    for (double t = 0; t < length; t += dt) {
      motion.emplace_back(t, observed(*model, "outer_displacement_x"));
      model->advance(dt);
    }
    double best = 0, most = 0;
    for (double share = 0.95; share < 1.05; share += 2e-4) {
      std::complex<double> sum = 0;
      for (const auto& [t, u] : motion)
        sum += u * (1 - std::cos(2 * std::numbers::pi * t / length)) * std::polar(1.0, share * omega * t);
      if (std::abs(sum) > most) most = std::abs(sum), best = share;
    }
    std::printf("spacing %g m: frequency %.4f 1/s, %+.2f %%\n", spacing, best * omega, 100 * (best - 1));
    EXPECT_NEAR(best, 1, spacing > 0.015 ? 4e-3 : 2e-3);
  }
}

}  // namespace
}  // namespace toryu::solid
