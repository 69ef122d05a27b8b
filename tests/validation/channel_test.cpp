// Media between two plates: pressure gradient and profile against the slit solutions, at 20 particles across.
#include "tests/validation/channel.hpp"

#include <gtest/gtest.h>

namespace toryu::fluid {
namespace {

constexpr double w = channel_width, U = mean_velocity;

TEST(DevelopedFlow, IsTheClosedFormWhereThereIsOne) {
  const DevelopedFlow newtonian([](double) { return 0.5; }, w, U);
  EXPECT_NEAR(newtonian.pressure_gradient(), -12 * 0.5 * U / (w * w), 0.01);
  EXPECT_NEAR(newtonian.velocity(0.25 * w), 1.5 * U * 0.75, 1e-5 * U);
  const double n = 0.5, m = 1.0, wall_rate = (2 * n + 1) / (3 * n) * 6 * U / w;
  const DevelopedFlow thinning([&](double gdot) { return m * std::pow(gdot, n - 1); }, w, U);
  EXPECT_NEAR(thinning.wall_stress(), m * std::pow(wall_rate, n), 1e-5);
  EXPECT_NEAR(thinning.velocity(0.25 * w), (1 + 2 * n) / (1 + n) * U * (1 - std::pow(0.5, 1 + 1 / n)),
              1e-5 * U);
}

TEST(SlitChannel, HasTheNewtonianPressureDropAndProfile) {
  const FluidCase the_case("slit_channel");
  const double mu = the_case.parameters.laminar_viscosity->dynamic_viscosity;
  const DevelopedFlow exact(viscosity_of(the_case.parameters), w, U);
  expect_within_two_percent(run_channel(the_case, exact), -12 * mu * U / (w * w));
}

TEST(SlitChannel, ShowsTheArtificialShareOfTheViscosity) {
  const FluidCase the_case("slit_channel", {"fluid.artificial_viscosity.alpha=1", "case.end_time=0.25"});
  const auto& p = the_case.parameters;
  const DevelopedFlow exact(viscosity_of(p), w, U);
  const double excess = run_channel(the_case, exact).pressure_gradient / exact.pressure_gradient() - 1;
  const double stated = p.density * effective_kinematic_viscosity(1, p.h(), p.sound_speed) /
                        p.laminar_viscosity->dynamic_viscosity;
  RecordProperty("excess_over_stated", std::to_string(excess / stated));
  EXPECT_GT(stated, 0.15);
  EXPECT_NEAR(excess / stated, 1.0, 0.25);
}

TEST(PowerLawChannel, HasThePressureDropAndProfileOfCarreau) {
  const FluidCase the_case("power_law_channel/carreau.toml");
  const DevelopedFlow exact(viscosity_of(the_case.parameters), w, U);
  expect_within_two_percent(run_channel(the_case, exact), exact.pressure_gradient());
}

}  // namespace
}  // namespace toryu::fluid
