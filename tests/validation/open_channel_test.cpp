// Flow through a channel with open ends: cases/open_channel against the developed flow, its balance of mass,
// and the sound that its ends send back.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

double column(const FluidModel& solver, const std::string& name) {
  for (const auto& seen : solver.observe())
    if (seen.name == name) return seen.value;
  throw std::logic_error(name);
}

TEST(OpenChannel, HasTheDevelopedFlowAndKeepsItsMassOverTenPassages) {
  // half as long as the case's
  WeaklyCompressible solver =
      FluidCase("open_channel", {"fluid.region.channel.box.max=[1,1]", "fluid.outlet.outlet.from=[1,0]",
                                 "fluid.outlet.outlet.to=[1,1]"})
          .solver();
  run_until(solver, 11);
  const auto& f = solver.particles();
  double largest = 0;
  for (std::size_t i = 0; i < f.count; ++i) {
    const double y = f.x[1][i];
    if (f.x[0][i] > 0 && f.x[0][i] < 0.9) largest = std::max(largest, std::abs(f.v[0][i] - 6 * y * (1 - y)));
  }
  EXPECT_LT(largest / 1.5, 0.01) << "of the largest speed; in the last row before the outlet 0.016";
  const double in = column(solver, "mass_through_inlet"), out = column(solver, "mass_through_outlet");
  EXPECT_GT(in, 1e4) << "ten times the channel's own mass";
  EXPECT_LT(std::abs(in - out) / in, 0.001);
  EXPECT_NEAR(solver.mass(), 1000 + in - out, 1e-6);
}

/// A channel of 4 m, at rest but for a hump of velocity in its middle, `width` [m] at half its height: half
/// of it runs to either end, with a pressure of either sign.
FluidCase channel_with_a_pulse(double width) {
  FluidCase channel("open_channel",
                    {"fluid.spacing=0.05", "fluid.sound_speed=10", "fluid.laminar_viscosity=false",
                     "fluid.background_pressure=false", "fluid.wall_model={slip=\"free_slip\"}",
                     "wall.lower.box.max=[4.4,0]", "wall.upper.box={min=[-0.4,0.5],max=[4.4,0.75]}",
                     "case.domain.max=[4.5,1.6]", "fluid.region.channel.box.max=[4,0.5]",
                     "fluid.inlet.inlet.to=[0,0.5]", "fluid.inlet.inlet.ramp_time=1e6",
                     "fluid.outlet.outlet.from=[4,0]", "fluid.outlet.outlet.to=[4,0.5]"});
  auto& regions = channel.parameters.regions;
  regions.clear();
  const double begin = 2 - width, step = 0.1;
  const auto add = [&](double from, double to, double u) {
    regions.push_back({"water", {Vec(from, 0), Vec(to, 0.5)}, Vec(u, 0)});
  };
  add(0, begin, 0);
  const int steps = static_cast<int>(std::round(2 * width / step));
  for (int k = 0; k < steps; ++k)
    add(begin + k * step, begin + (k + 1) * step,
        0.005 * (1 - std::cos(2 * std::numbers::pi * (k + 0.5) / steps)));
  add(2 + width, 4, 0);
  return channel;
}

/// Mean pressure about x, over the width of the channel [Pa].
double pressure_at(const WeaklyCompressible& solver, double x) {
  const auto& f = solver.particles();
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < f.count; ++i)
    if (std::abs(f.x[0][i] - x) < 0.1) {
      sum += f.p[i];
      ++count;
    }
  return sum / count;
}

/// Width of the pulse [m], and the largest share that may come back: some width/(4 L).
class OpenEndsOfAChannel : public testing::TestWithParam<std::pair<double, double>> {};
INSTANTIATE_TEST_SUITE_P(Pulses, OpenEndsOfAChannel,
                         testing::Values(std::pair(0.4, 0.05), std::pair(0.8, 0.06)));

TEST_P(OpenEndsOfAChannel, SendBackLittleOfAPulse) {
  const auto [width, share] = GetParam();
  const FluidCase channel = channel_with_a_pulse(width);
  WeaklyCompressible solver = channel.solver();
  // It passes 1 m before the ends at 0.1 s, and what comes back of it at 0.3 s.
  double there = 0, back_from_inlet = 0, back_from_outlet = 0;
  while (solver.time() < 0.42) {
    solver.advance(solver.time_step_limit());
    const double near_inlet = std::abs(pressure_at(solver, 1)),
                 near_outlet = std::abs(pressure_at(solver, 3));
    if (solver.time() < 0.2) there = std::max({there, near_inlet, near_outlet});
    if (solver.time() < 0.25) continue;
    back_from_inlet = std::max(back_from_inlet, near_inlet);
    back_from_outlet = std::max(back_from_outlet, near_outlet);
  }
  RecordProperty("share_from_inlet", std::to_string(back_from_inlet / there));
  RecordProperty("share_from_outlet", std::to_string(back_from_outlet / there));
  EXPECT_GT(there, 30) << "of rho c u/2 = 50 Pa";
  EXPECT_LT(back_from_inlet, share * there);
  EXPECT_LT(back_from_outlet, share * there);
}

}  // namespace
}  // namespace toryu::fluid
