/// Particles that fit round and slanted outlines, against exact solutions of elasticity.

#include <cmath>

#include "solid_case.hpp"
#include "tests/one_thread.hpp"

namespace toryu::solid {
namespace {

struct StressAt {
  double xx, yy, xy;
};

StressAt stress(const SolidModel& model, const std::string& observer) {
  return {observed(model, observer + "_stress_xx"), observed(model, observer + "_stress_yy"),
          observed(model, observer + "_stress_xy")};
}

/// A case at rest.
std::unique_ptr<SolidModel> at_rest(const std::string& name, double end_time, double spacing) {
  auto model = solid_case(name, {fmt::format("solid.spacing={:g}", spacing)});
  run_to(*model, end_time);
  model->check(end_time);
  return model;
}

TEST(PressedRing, HasLamesStresses) {
  const double a = 0.05, b = 0.1, p = 10e6, E = 210e9, nu = 0.3;
  const auto model = at_rest("pressed_ring/case.toml", 5e-4, 0.005);
  for (const auto& [name, r] : {std::pair("bore", a), {"middle", 0.075}, {"outside", b}}) {
    const double scale = p * a * a / (b * b - a * a);
    const double hoop = scale * (1 + b * b / (r * r)), radial = scale * (1 - b * b / (r * r));
    const double u = (1 + nu) / E * scale * ((1 - 2 * nu) * r + b * b / r);
    const StressAt sigma = stress(*model, name);
    std::printf("%s: hoop %.4f, radial %.4f of p off, displacement %.4f\n", name, sigma.yy / hoop,
                (sigma.xx - radial) / p, observed(*model, std::string(name) + "_displacement_x") / u);
    EXPECT_NEAR(sigma.yy / hoop, 1.0, 0.015);
    EXPECT_NEAR((sigma.xx - radial) / p, 0.0, 0.01);
    EXPECT_NEAR(observed(*model, std::string(name) + "_displacement_x") / u, 1.0, 0.01);
  }
}

TEST(PlateWithHole, ConcentratesStressAsHowlandHasIt) {
  const double concentration = 3.14;  // of the mean far away, for a hole a fifth as wide as the plate
  const auto model = at_rest("plate_with_hole/case.toml", 1e-3, 0.004);
  const double factor = stress(*model, "side").xx / 1e6;
  std::printf("factor %.4f, front %.4f\n", factor, stress(*model, "front").yy / 1e6);
  EXPECT_NEAR(factor / concentration, 1.0, 0.03);
}

/// Stress along a quarter ring at `angle` from its end, where a force P acts in the plane of the end's face,
/// and as far as `arm` before it (Timoshenko & Goodier 1970, articles 29 and 33) [Pa].
double along_quarter_ring(double r, double angle, double P, double arm) {
  const double a = 0.01, b = 0.02, a2 = a * a, b2 = b * b, r2 = r * r, log_ba = std::log(b / a);
  const double N = a2 - b2 + (a2 + b2) * log_ba;
  const double by_force = P / N * (3 * r - a2 * b2 / (r2 * r) - (a2 + b2) / r) * std::sin(angle);
  const double M = P * arm, D = (b2 - a2) * (b2 - a2) - 4 * a2 * b2 * log_ba * log_ba;
  const double by_moment =
      4 * M / D * (-a2 * b2 / r2 * log_ba + b2 * std::log(r / b) + a2 * std::log(a / r) + b2 - a2);
  return by_force + by_moment;
}

TEST(CurvedBeam, BendsAsElasticityHasIt) {
  const auto model = at_rest("curved_beam/case.toml", 4e-3, 0.001);
  for (const auto& [name, r] : {std::pair("inner", 0.01), {"outer", 0.02}}) {
    const StressAt sigma = stress(*model, name);
    const double along = 0.5 * (sigma.xx + sigma.yy) - sigma.xy;  // at 45 degrees
    const double exact = along_quarter_ring(r, M_PI / 4, 100.0, 0.003);
    std::printf("%s %.5g Pa, exact %.5g, ratio %.4f\n", name, along, exact, along / exact);
    EXPECT_NEAR(along / exact, 1.0, 0.03);
  }
}

}  // namespace
}  // namespace toryu::solid
