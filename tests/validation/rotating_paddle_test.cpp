/// The rotating paddle without a medium: how far its blades are stretched as they turn.
#include <gtest/gtest.h>

#include <cmath>

#include "solid_case.hpp"

namespace toryu::solid {
namespace {

TEST(RotatingPaddle, IsStretchedByItsTurning) {
  // E' u(r) = rho omega^2/2 (L^2 (r - r_0) - (r^3 - r_0^3)/3), E' = E/(1 - nu^2).
  const double omega = 20, L = 0.064, r_0 = 0.008, E = 5e5 / (1 - 0.09);
  const double exact =
      0.5 * 1100 * omega * omega / E * (L * L * (L - r_0) - (L * L * L - r_0 * r_0 * r_0) / 3);
  for (const double spacing : {0.004, 0.002}) {
    const auto model = solid_case("rotating_paddle/vacuum.toml", {fmt::format("solid.spacing={}", spacing)});
    run_to(*model, 1.1);
    double stretch = 0, count = 0;
    for (double time = 1.1; time < 1.2; time += 2e-3, ++count) {
      run_to(*model, 2e-3);
      for (const auto& [tip, side] : {std::pair("right tip", 1.0), std::pair("left tip", -1.0)}) {
        const double x = side * L + observed(*model, std::string(tip) + "_displacement_x"),
                     y = observed(*model, std::string(tip) + "_displacement_y");
        stretch += 0.5 * (std::hypot(x, y) - L);
      }
    }
    std::printf("spacing %g m: tip %.3f um out, %+.2f %%\n", spacing, 1e6 * stretch / count,
                100 * (stretch / count / exact - 1));
    EXPECT_NEAR(stretch / count, exact, 0.012 * exact);
  }
}

}  // namespace
}  // namespace toryu::solid
