// A Bingham medium between plates under a body force: cases/poiseuille/bingham.toml against the exact
// profile, a plug between two parabolas (Bird, Armstrong & Hassager 1987, section 4.2).
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace yield_stress_test {

constexpr double width = 1;

/// Without any regularisation.
double exact_velocity(const FluidCase& the_case, double y) {
  const HerschelBulkley& law = *the_case.parameters.herschel_bulkley;
  const double slope = the_case.parameters.density * the_case.scene.gravity[0];  // of the shear stress
  const auto beyond_yield = [&](double stress) { return std::max(stress - law.yield_stress, 0.0); };
  const double at_wall = beyond_yield(0.5 * slope * width),
               here = beyond_yield(slope * std::abs(y - 0.5 * width));
  return (at_wall * at_wall - here * here) / (2 * law.consistency * slope);
}

struct Profile {
  double error = 0;  ///< largest of the twentieths of the width, over the plug's speed
  double plug = 0;   ///< largest difference of speed in the middle fifth, over the plug's speed
};

Profile profile_at(double spacing) {
  const FluidCase the_case("poiseuille/bingham.toml", {"fluid.spacing=" + std::to_string(spacing)});
  const double fastest = exact_velocity(the_case, 0.5 * width);
  WeaklyCompressible solver = the_case.solver();
  run_until(solver, the_case.scene.end_time);
  const auto& f = solver.particles();
  constexpr std::size_t bins = 20;
  std::array<double, bins> difference{}, count{};
  double slowest_in_plug = fastest, fastest_in_plug = 0;
  for (std::size_t i = 0; i < f.count; ++i) {
    const double y = f.x[1][i], u = f.v[0][i];
    const auto bin = static_cast<std::size_t>(std::clamp(y / width * bins, 0.0, bins - 1.0));
    difference[bin] += u - exact_velocity(the_case, y);
    count[bin] += 1;
    if (std::abs(y - 0.5 * width) > 0.1 * width) continue;
    slowest_in_plug = std::min(slowest_in_plug, u);
    fastest_in_plug = std::max(fastest_in_plug, u);
  }
  Profile profile;
  for (std::size_t b = 0; b < bins; ++b)
    if (count[b] > 0) profile.error = std::max(profile.error, std::abs(difference[b] / count[b]) / fastest);
  profile.plug = (fastest_in_plug - slowest_in_plug) / fastest;
  ::testing::Test::RecordProperty("profile_and_plug_at_" + std::to_string(std::lround(width / spacing)),
                                  std::to_string(profile.error) + " " + std::to_string(profile.plug));
  return profile;
}

TEST(Bingham, FlowsAsAPlugBetweenParabolas) {
  const Profile coarse = profile_at(0.1), fine = profile_at(0.05);
  EXPECT_LT(fine.error, 0.02);
  EXPECT_LT(fine.error, coarse.error / 1.3);
  EXPECT_LT(fine.plug, 0.02);
}

}  // namespace yield_stress_test
}  // namespace toryu::fluid
