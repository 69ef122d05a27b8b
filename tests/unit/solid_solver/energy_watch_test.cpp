#include "solid_solver/energy_watch.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"
#include "tests/said.hpp"

namespace toryu::solid {
namespace {

TEST(EnergyWatch, TellsOfTwoPercentOfTheMostAndOfEachDoubling) {
  const Said heard;
  EnergyWatch watch;
  watch.warn_of_gain(0, 0, 0, 0);
  watch.warn_of_gain(20, 25, 0, 1);  // 5 J held by deformation, or dissipated
  watch.warn_of_gain(10, 9.7, 0, 2);
  EXPECT_EQ(heard.text(), "");
  EXPECT_NEAR(watch.largest_gain, 0.015, 1e-12);
  std::size_t length = 0;
  for (const auto& [gained, told] : {std::pair{0.5, true}, {0.9, false}, {1.1, true}, {0.2, false}}) {
    watch.warn_of_gain(10, 10 - gained, 0, 3);
    EXPECT_EQ(heard.text().size() > length, told) << gained;
    length = heard.text().size();
  }
  EXPECT_NE(heard.text().find("0.025 of it"), std::string::npos) << heard.text();
  EXPECT_NEAR(watch.largest_gain, 0.055, 1e-12);
}

TEST(EnergyWatch, TakesNoRoundingForMotion) {
  const Said heard;
  EnergyWatch watch;
  watch.warn_of_gain(3e-36, 1e-36, 1e-20, 1);
  EXPECT_EQ(heard.text(), "");
  EXPECT_EQ(watch.largest_gain, 0);
  watch.warn_of_gain(3e-19, 1e-19, 1e-20, 2);
  EXPECT_NE(heard.text(), "");
}

/// Largest gain of a free bar that swings along its length, in updated form, by steps of `courant_number`.
double gain(double courant_number) {
  Parameters p = free_plate(5);
  p.hourglass.reset();
  p.formulation = Formulation::updated_lagrangian;
  p.courant_number = courant_number;
  p.initial_velocity =
      InitialVelocity{.profile = VelocityProfile::linear, .gradient = {{1.0, 0.0}, {0.0, -1.0}}};
  const auto bar = model_of(p);
  for (int n = 0; n < 300; ++n) bar->advance(bar->time_step_limit());
  for (const auto& [name, value] : bar->figures())
    if (name == "largest_energy_gain") return value;
  return -1;
}

TEST(EnergyWatch, SeesWhatMidpointStepsThatAreTooLongFeedASolid) {
  const Said heard;
  EXPECT_NEAR(gain(0.1), 0, 1e-3);
  EXPECT_EQ(heard.text(), "");
  EXPECT_GT(gain(1.0), 0.02);
  EXPECT_NE(heard.text().find("from nowhere"), std::string::npos);
}

}  // namespace
}  // namespace toryu::solid
