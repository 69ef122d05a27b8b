// Pistons that are pressed, by implicit steps: what flows through slits between them and through a throat,
// and the pressure at which they hold the medium.
#include <gtest/gtest.h>

#include "tests/validation/channel.hpp"
#include "tests/validation/pressed_throat.hpp"

namespace toryu::fluid {
namespace {

/// Means of the last 12 ms of a slit between two pistons, between its observers 4 mm apart.
struct PressedSlit {
  double speed = 0;     ///< of the pistons [m/s]
  double gradient = 0;  ///< of the pressure [Pa/m]
};

PressedSlit run_pressed_slit(const FluidCase& the_case) {
  const auto solver = make_model(the_case.parameters, the_case.scene);
  PressedSlit sum;
  int samples = 0;
  for (double time = the_case.scene.end_time - 0.012; time < the_case.scene.end_time + 1e-9; time += 5e-4) {
    run_until(*solver, time);
    for (const auto& column : solver->observe()) {
      if (column.name == "speed_of_pushing_piston") sum.speed += 0.5 * column.value;
      if (column.name == "speed_of_leading_piston") sum.speed -= 0.5 * column.value;
      if (column.name == "pressure_upstream") sum.gradient -= column.value / 0.004;
      if (column.name == "pressure_downstream") sum.gradient += column.value / 0.004;
    }
    ++samples;
  }
  return {sum.speed / samples, sum.gradient / samples};
}

std::vector<std::string> newtonian_at(const char* spacing) {
  return {std::string("fluid.spacing=") + spacing, "fluid.power_law=false",
          "fluid.wall_model.extrapolation=\"mean\"", "fluid.laminar_viscosity.dynamic_viscosity=1000",
          "fluid.implicit.expected_speed=0.08"};
}

/// Flow rate over that of the gradient between plates w apart, G w^2/(12 mu).
double flow_over_poiseuille(const char* spacing) {
  const PressedSlit flow =
      run_pressed_slit(FluidCase("abrasive_slit/implicit_pressed.toml", newtonian_at(spacing)));
  testing::Test::RecordProperty(std::string("flow_rate_at_") + spacing, std::to_string(flow.speed));
  return flow.speed / (-flow.gradient * 0.002 * 0.002 / (12 * 1000));
}

TEST(ImplicitPressedSlit, HasTheFlowRateOfItsPressureDrop) {
  const double coarse = flow_over_poiseuille("2e-4"), fine = flow_over_poiseuille("1e-4");
  RecordProperty("over_exact", fmt::format("{} {}", coarse, fine));
  EXPECT_NEAR(coarse, 1, 0.05);
  EXPECT_NEAR(fine, 1, 0.02);
  EXPECT_LT(std::abs(fine - 1), 0.5 * std::abs(coarse - 1));
}

TEST(ImplicitPressedSlit, HasThePressureDropOfAPowerLaw) {
  const FluidCase the_case("abrasive_slit/implicit_pressed.toml");
  const PressedSlit flow = run_pressed_slit(the_case);
  const DevelopedFlow exact(viscosity_of(the_case.parameters), 0.002, flow.speed);
  RecordProperty("over_exact", std::to_string(flow.gradient / exact.pressure_gradient()));
  EXPECT_NEAR(flow.gradient / exact.pressure_gradient(), 1, 0.02);
}

// The medium slides along the walls with u_s = b tau_w: what little it is sheared at the ends of the slit
// counts no more, and the whole of it has the pressure drop of the presses, U = G (w^2/(12 mu) + b w/2).
TEST(ImplicitPressedSlit, HasTheFlowRateOfThePressesWhereItSlides) {
  for (const char* spacing : {"2e-4", "1e-4"}) {
    const PressedSlit flow = run_pressed_slit(
        FluidCase("abrasive_slip/implicit_pressed.toml", {std::string("fluid.spacing=") + spacing}));
    const double gradient = 0.6e6 / 0.016, b = 1e-6, w = 0.002;
    const double exact = gradient * (w * w / (12 * 1000) + 0.5 * b * w);
    RecordProperty(std::string("over_exact_at_") + spacing, std::to_string(flow.speed / exact));
    EXPECT_NEAR(flow.speed / exact, 1, 0.02) << spacing;
    EXPECT_NEAR(-flow.gradient / gradient, 1, 0.02) << spacing;
  }
}

TEST(ImplicitPressedThroat, HasThePressuresOfItsPressAndTheirFlow) {
  const PressedThroat flow = run_pressed_throat(FluidCase("abrasive_throat/implicit_pressed.toml"), 0.008);
  RecordProperty("drop_over_reference", std::to_string(flow.drop));
  RecordProperty("upstream", std::to_string(flow.upstream));
  RecordProperty("downstream", std::to_string(flow.downstream));
  RecordProperty("mean", std::to_string(flow.mean));
  EXPECT_NEAR(flow.drop, 1,
              0.07);  // of the spacing: as by prescribed motion (cases/abrasive_throat/README.md)
  EXPECT_NEAR(flow.upstream, 0, 0.02);
  EXPECT_NEAR(flow.downstream, 0, 0.02);
  EXPECT_NEAR(flow.mean, 0, 0.01);
}

}  // namespace
}  // namespace toryu::fluid
