// The case by implicit steps that --check holds against similarity.
#include "fluid_solver/implicit/implicit_twin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_solver/implicit/implicit_faults.hpp"

namespace toryu::fluid {
namespace {

using testing::HasSubstr;

// The passage of 2 mm at 50 mm/s, of 1000 Pa s: 150 kPa at the wall, 2.4 MPa over 16 mm.
TEST(ImplicitTwin, HasTheOwnDensityAndTheSameCompression) {
  Parameters p;
  p.density = 1200;
  p.laminar_viscosity = LaminarViscosity{1000};
  p.density_diffusion = DensityDiffusion{};
  EXPECT_FALSE(implicit_twin(p, {}));
  p.similarity = Similarity{.mean_speed = 0.05, .passage_width = 0.002, .passage_length = 0.016};
  const Parameters twin = implicit_twin(p, {}).value();
  EXPECT_EQ(twin.density, 1200);
  EXPECT_NEAR(twin.sound_speed, std::sqrt(2.4e6 / (0.01 * 1200)), 0.01);
  EXPECT_NEAR(twin.background_pressure->pressure, 0.65 * 2.4e6, 1);
  EXPECT_NEAR(twin.implicit->expected_speed, 0.075, 1e-12);
  EXPECT_THAT(keys_of_twin(twin),
              HasSubstr("model = \"implicit\", similarity = false, sound_speed = 447.2,"));
  EXPECT_TRUE(implicit_faults(twin, {}, false).empty());
  EXPECT_THAT(keys_of_twin(twin), HasSubstr("implicit = { expected_speed = 0.075, tolerance = 0.0001 }"));
  Scene pressed;
  pressed.walls.resize(1);
  pressed.walls[0].press.emplace();
  EXPECT_EQ(implicit_twin(p, pressed)->implicit->tolerance, 1e-3);
  EXPECT_NEAR(implicit_twin(p, pressed)->background_pressure->pressure, 0.8 * 2.4e6, 1);
  p.friction = Friction{};
  EXPECT_FALSE(implicit_twin(p, {}));
}

}  // namespace
}  // namespace toryu::fluid
