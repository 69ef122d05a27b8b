// A medium that slides along a tube, a bore and a pin: against the exact solutions with slip, Coulomb's duct,
// and what comes off, whatever the spacing; in real pascals.
#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

TEST(AxisymmetricSlip, SolutionIsTheOneByHand) {
  // U = G (R^2/(8 mu) + b R/2), u_s = b G R/2
  const DevelopedFlow exact = exact_of("axisymmetric_tube/slip.toml");
  const double G = 0.05 / (1e-6 / 8e3 + 3e-7 * 5e-4);
  EXPECT_NEAR(-exact.pressure_gradient(), G, 1e-5 * G);
  EXPECT_NEAR(exact.slip_speed(), 3e-7 * G * 5e-4, 1e-7);
}

TEST(AxisymmetricSlip, HasThePressureDropAndSlipOfANewtonianMedium) {
  expect_sliding("axisymmetric_tube/slip.toml", 1e-4, 0.02, 0.02);
}

/// Means over the second half of a run of cases/abrasive_bore.
struct Wear {
  double slip_speed = 0;  ///< of a work piece [m/s]
  double rate = 0;        ///< removed depth [m/s], mean of all
};

Wear wear_of(const FluidCase& the_case, const std::string& work_piece) {
  WeaklyCompressible solver = the_case.solver();
  const auto out = std::filesystem::path(testing::TempDir()) / ("abrasive_bore_" + std::to_string(getpid()));
  std::filesystem::create_directories(out);
  solver.record_surface(out);
  const auto depth = [&] {
    for (const auto& seen : solver.observe())
      if (seen.name == "removed_depth_mean") return seen.value;
    return 0.0;
  };
  const double half = 0.5 * the_case.scene.end_time;
  run_until(solver, half);
  const double before = depth();
  run_until(solver, 2 * half);
  Wear wear{.rate = (depth() - before) / half};
  double count = 0;
  for (const Boundary& body : solver.boundaries())
    for (std::size_t k = 0; k < body.count; ++k)
      if (body.name == work_piece && (body.lower_face[1][k] > 0 || body.upper_face[1][k] > 0) &&
          body.slip_velocity[0][k] > 0)
        wear.slip_speed += body.slip_velocity[0][k], ++count;
  wear.slip_speed /= count;
  std::filesystem::remove_all(out);
  return wear;
}

TEST(AbrasiveBore, WearsByPressureTimesSlipWhateverTheSpacing) {
  const double u_s = 3e-7 * 1.5e8 * 1e-3 / 2, rate = 2.5e-12 * 1.5e6 * u_s;
  for (const char* spacing : {"2e-4", "1e-4"}) {
    const Wear wear = wear_of(FluidCase("abrasive_bore", {std::string("fluid.spacing=") + spacing}), "bore");
    testing::Test::RecordProperty(
        std::string("slip_and_rate_over_exact_at_") + spacing,
        std::to_string(wear.slip_speed / u_s) + " " + std::to_string(wear.rate / rate));
    EXPECT_NEAR(wear.slip_speed / u_s, 1, 0.02) << spacing;
    EXPECT_NEAR(wear.rate / rate, 1, 0.02) << spacing;
  }
}

TEST(AbrasiveBore, WearsAPinByTheSlipOfAnAnnulus) {
  // v = A + B ln r - G r^2/(4 eta); v = b tau at the pin, v = - b tau at the bore
  const double eta = 1000, b = 3e-7, G = 1.5e8, R_1 = 5e-4, R_2 = 1e-3;
  const auto slope = [&](double r) { return -G * r / (2 * eta); };  // dv/dr of the last part
  const double v_1 = -G * R_1 * R_1 / (4 * eta), v_2 = -G * R_2 * R_2 / (4 * eta), l = b * eta;
  // A + B (ln R_1 - l/R_1) = l slope_1 - v_1, A + B (ln R_2 + l/R_2) = - l slope_2 - v_2
  const double B =
      (-l * slope(R_2) - v_2 - l * slope(R_1) + v_1) / (std::log(R_2) + l / R_2 - std::log(R_1) + l / R_1);
  const double on_pin = l * (slope(R_1) + B / R_1), on_bore = -l * (slope(R_2) + B / R_2);
  const FluidCase the_case("abrasive_bore/pin.toml");
  const Wear pin = wear_of(the_case, "pin");
  testing::Test::RecordProperty("slip_over_exact", std::to_string(pin.slip_speed / on_pin));
  EXPECT_NEAR(pin.slip_speed / on_pin, 1, 0.02);
  const double mean = (R_1 * on_pin + R_2 * on_bore) / (R_1 + R_2);  // by the areas of the rings
  testing::Test::RecordProperty("rate_over_exact", std::to_string(pin.rate / (2.5e-12 * 1.5e6 * mean)));
  EXPECT_NEAR(pin.rate / (2.5e-12 * 1.5e6 * mean), 1, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
