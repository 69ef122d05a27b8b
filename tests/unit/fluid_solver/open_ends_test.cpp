// Open ends of channels: profiles, layers, who crosses, what the layers show and give.
#include "fluid_solver/open_ends/open_ends.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "tests/one_thread.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"

namespace {
std::atomic<long> allocations{0};

void* counted(void* memory) {
  ++allocations;
  return memory ? memory : throw std::bad_alloc();
}
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace toryu::fluid {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

Inlet inlet_across(double height) {
  return {{"inlet", Vec(0, 0), Vec(0, height)}, InflowProfile::uniform, 0, 0, {}, 0, {}};
}

TEST(AnInlet, HasAUniformSpeed) {
  Inlet inlet = inlet_across(2);
  inlet.mean_speed = 3;
  EXPECT_EQ(inlet.speed_at(0.1, 0), 3);
  EXPECT_EQ(inlet.speed_at(0.1, -1), 3) << "without a ramp it was there before";
  EXPECT_EQ(inlet.mean_at(0), 3);
}

TEST(AnInlet, HasAParabolaOfItsMeanOrItsLargest) {
  Inlet inlet = inlet_across(2);
  inlet.profile = InflowProfile::parabolic;
  inlet.mean_speed = 2;  // 6 u_m y (H - y)/H^2
  EXPECT_DOUBLE_EQ(inlet.speed_at(1, 0), 3);
  EXPECT_DOUBLE_EQ(inlet.speed_at(0.5, 0), 2.25);
  EXPECT_EQ(inlet.speed_at(0, 0), 0);
  EXPECT_EQ(inlet.speed_at(2, 0), 0);
  EXPECT_DOUBLE_EQ(inlet.mean_at(0), 2);
  EXPECT_EQ(inlet.largest_speed_ever(), 3);
  inlet.mean_speed = 0;
  inlet.largest_speed = 6;
  EXPECT_DOUBLE_EQ(inlet.speed_at(0.5, 0), 4.5);
  EXPECT_DOUBLE_EQ(inlet.mean_at(0), 4);
}

TEST(AnInlet, HasTheSpeedsOfATable) {
  Inlet inlet = inlet_across(2);
  inlet.speeds = {{0.5, 1}, {1.5, 3}};
  EXPECT_EQ(inlet.speed_at(0.2, 0), 1);
  EXPECT_EQ(inlet.speed_at(1, 0), 2);
  EXPECT_EQ(inlet.speed_at(1.9, 0), 3);
  EXPECT_DOUBLE_EQ(inlet.mean_at(0), (0.5 * 1 + 1.0 * 2 + 0.5 * 3) / 2);
}

TEST(AnInlet, BeginsByACosine) {
  Inlet inlet = inlet_across(1);
  inlet.mean_speed = 2;
  inlet.ramp_time = 4;
  EXPECT_EQ(inlet.speed_at(0.5, 0), 0);
  EXPECT_DOUBLE_EQ(inlet.speed_at(0.5, 1), 1 - std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(inlet.speed_at(0.5, 2), 1);
  EXPECT_EQ(inlet.speed_at(0.5, 4), 2);
  EXPECT_EQ(inlet.speed_at(0.5, 9), 2);
}

TEST(AnInlet, FollowsATableOverTime) {
  Inlet inlet = inlet_across(1);
  inlet.mean_speed = 2;
  inlet.over_time = {{1, 0}, {2, 1}, {4, 0.5}};
  EXPECT_EQ(inlet.speed_at(0.5, 0), 0);
  EXPECT_EQ(inlet.speed_at(0.5, 1.5), 1);
  EXPECT_EQ(inlet.speed_at(0.5, 3), 1.5);
  EXPECT_EQ(inlet.speed_at(0.5, 5), 1);
}

TEST(AnOutlet, HasItsPressureOverTime) {
  Outlet outlet{{"outlet", Vec(0, 0), Vec(0, 1)}, 7, {}};
  EXPECT_EQ(outlet.pressure_at(3), 7);
  outlet.pressure_rows = {{0, 0}, {2, 100}};
  EXPECT_EQ(outlet.pressure_at(1), 50);
}

/// A channel of 2 m by 0.5 m.
Setting channel() {
  Setting s = empty_space();
  open_channel(s, 0, 2, 0.5);
  return s;
}

TEST(ALineOfAnOpenEnd, KnowsWhereTheFluidIs) {
  const Setting s = channel();
  const auto sections = sections_of(s.parameters);
  ASSERT_EQ(sections.size(), 2);
  EXPECT_EQ(sections[0].inward, Vec(1, 0));
  EXPECT_EQ(sections[1].inward, Vec(-1, 0));
  EXPECT_EQ(sections[0].length, 0.5);
  // 2 (1 + 0.12) 2 1.3 = 5.82 spacings
  EXPECT_DOUBLE_EQ(sections[0].depth, 0.3);
  EXPECT_DOUBLE_EQ(sections[0].distance(Vec(-0.1, 0.2)), -0.1);
  EXPECT_DOUBLE_EQ(sections[0].place(Vec(-0.1, 0.2)), 0.2);
  EXPECT_NEAR(sections[1].distance(Vec(2.1, 0.2)), -0.1, 1e-12);
}

TEST(ALineOfAnOpenEnd, IsNoneInTheMidstOfTheFluidOrOutside) {
  Setting s = channel();
  s.parameters.inlets[0].from[0] = s.parameters.inlets[0].to[0] = 1;
  EXPECT_FALSE(section_of(s.parameters.inlets[0], s.parameters));
  s.parameters.inlets[0].from[0] = s.parameters.inlets[0].to[0] = -1;
  EXPECT_FALSE(section_of(s.parameters.inlets[0], s.parameters));
}

TEST(AnInlet, IsWarnedOfThatBeginsAtOnce) {
  Setting s = channel();
  EXPECT_THAT(
      abrupt_inlets(s.parameters),
      ElementsAre(
          "the inlet 'inlet' begins at once with a mean of 1 m/s, and the fluid before it starts with "
          "0 m/s: a blow of rho c times the difference, 2e+04 Pa, runs through the channel; give it a "
          "'ramp_time' of some passages of sound"));
  s.parameters.regions[0].velocity = Vec(1, 0);
  EXPECT_TRUE(abrupt_inlets(s.parameters).empty());
  s.parameters.regions[0].velocity = Vec::Zero();
  s.parameters.inlets[0].ramp_time = 1;
  EXPECT_TRUE(abrupt_inlets(s.parameters).empty());
}

/// Particles of a channel and its layers, and their ends.
struct Filled {
  Filled() : Filled(channel()) {}
  explicit Filled(const Setting& s) : fluid(s.solver().particles()), ends(s.parameters, {1000, 20, 7, 3e3}) {
    ends.assign_layers(fluid);
  }
  /// All whose centre is nearer than half a spacing to `place` [m].
  std::vector<std::uint32_t> near(const Vec& place) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < fluid.count; ++i)
      if ((at(fluid.x, i) - place).lpNorm<Eigen::Infinity>() < 0.02) found.push_back(i);
    return found;
  }
  void move(double by) {
    for (std::size_t i = 0; i < fluid.count; ++i) fluid.x[0][i] += by;
  }
  void exchange() {
    ends.exchange(fluid, [](std::size_t) { return 2.0; });
    ends.find(fluid);
  }
  Particles fluid;
  OpenEnds ends;
};

TEST(Layers, AreSixRowsDeep) {
  const Filled channel;
  std::vector<int> count(3);
  for (std::size_t i = 0; i < channel.fluid.count; ++i)
    ++count[static_cast<std::size_t>(channel.fluid.open_end[i])];
  EXPECT_THAT(count, ElementsAre(40 * 10, 6 * 10, 6 * 10));
  EXPECT_NEAR(channel.ends.layer_mass(), 1000 * 2 * 0.3 * 0.5, 1e-9);
}

TEST(Layers, AreFilledUpBehindTheirLastRowAndEmptiedAtTheirEnds) {
  Filled channel;
  const std::size_t count = channel.fluid.count;
  for (auto& u : channel.fluid.v[0]) u = 1;
  channel.move(0.02);  // nobody crosses a line, nor a far end
  channel.exchange();
  EXPECT_EQ(channel.fluid.count, count);
  EXPECT_EQ(channel.ends.state(0).mass, 0);
  channel.move(0.03 + 1e-9);
  channel.exchange();
  EXPECT_EQ(channel.fluid.count, count) << "a row comes in at the inlet, and one leaves at the outlet";
  EXPECT_NEAR(channel.ends.state(0).mass, 0.5 * 0.05 * 1000, 1e-9);
  EXPECT_NEAR(channel.ends.state(1).mass, -0.5 * 0.05 * 1000, 1e-9);
  EXPECT_NEAR(channel.ends.state(0).impulse[0], 25, 1e-9);
  EXPECT_NEAR(channel.ends.state(0).work, 50, 1e-9);
  for (double y = 0.025; y < 0.5; y += 0.05) {
    const auto row = channel.near(Vec(-0.275, y));
    ASSERT_EQ(row.size(), 1);
    EXPECT_NEAR(channel.fluid.x[0][row[0]], -0.275, 1e-8) << "a spacing behind the one before it";
    EXPECT_NEAR(channel.fluid.x[1][row[0]], y, 1e-12);
    EXPECT_EQ(channel.fluid.open_end[row[0]], 1);
    EXPECT_GE(channel.fluid.id[row[0]], count) << "with a number of its own";
    EXPECT_NEAR(channel.fluid.m[row[0]], 2.5, 1e-9);
    ASSERT_EQ(channel.near(Vec(0.025, y)).size(), 1);
    EXPECT_EQ(channel.fluid.open_end[channel.near(Vec(0.025, y))[0]], 0);
    ASSERT_EQ(channel.near(Vec(2.025, y)).size(), 1);
    EXPECT_EQ(channel.fluid.open_end[channel.near(Vec(2.025, y))[0]], 2);
    EXPECT_TRUE(channel.near(Vec(2.325, y)).empty());
  }
  auto ids = channel.fluid.id;
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
}

TEST(Layers, TakeBackWhatRunsOutOfAnInlet) {
  Filled channel;
  const std::size_t count = channel.fluid.count;
  for (auto& u : channel.fluid.v[0]) u = -1;
  channel.move(-0.05 - 1e-9);
  channel.exchange();
  EXPECT_EQ(channel.fluid.count, count);
  EXPECT_NEAR(channel.ends.state(0).mass, -25, 1e-9);
  EXPECT_NEAR(channel.ends.state(1).mass, 25, 1e-9);
  EXPECT_TRUE(channel.near(Vec(-0.325, 0.225)).empty());
}

TEST(Layers, TakeNoMemoryAsParticlesComeAndGo) {
  Filled channel;
  for (auto& u : channel.fluid.v[0]) u = 1;
  channel.ends.impose(channel.fluid, 0, Vec::Zero());
  const auto pass = [&](double begin) {
    for (int step = 0; step < 40; ++step) {
      channel.ends.impose(channel.fluid, begin + 0.001 * step, Vec::Zero());
      channel.ends.take_rates(channel.fluid, true, true);
      channel.ends.count(0.001);
      channel.move(0.01);
      channel.exchange();
    }
  };
  pass(0);  // a channel's layers and more
  const long before = allocations, through = std::lround(channel.ends.state(0).mass);
  pass(0.04);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(std::lround(channel.ends.state(0).mass), through);
}

/// Gives the fluid the profile of a mean of 1 m/s, and the pressure `p` + `gradient` x above the background.
void give(Filled& channel, double p, double gradient) {
  const EquationOfState state{1000, 20, 7, 3e3};
  for (std::size_t i = 0; i < channel.fluid.count; ++i)
    if (channel.fluid.is_inside(i)) {
      const double y = channel.fluid.x[1][i];
      set(channel.fluid.v, i, Vec(6 * y * (0.5 - y) / 0.25, 0));
      channel.fluid.rho[i] = state.density(3e3 + p + gradient * channel.fluid.x[0][i]);
    }
}

TEST(TheLayerOfAnInlet, HasTheProfileAndTheFluidsPressureOnALine) {
  Filled channel;
  const EquationOfState state{1000, 20, 7, 3e3};
  give(channel, 500, -200);
  channel.ends.impose(channel.fluid, 0, Vec::Zero());
  for (std::size_t i = 0; i < channel.fluid.count; ++i) {
    if (channel.fluid.open_end[i] != 1) continue;
    const Vec x = at(channel.fluid.x, i);
    EXPECT_NEAR(channel.fluid.v[0][i], 6 * x[1] * (0.5 - x[1]) / 0.25, 1e-12);
    EXPECT_EQ(channel.fluid.v[1][i], 0);
    EXPECT_NEAR(state.pressure(channel.fluid.rho[i]), 3e3 + 500 - 200 * x[0], 1e-6);
  }
  EXPECT_NEAR(channel.ends.state(0).means.pressure, 500, 1e-6);
  EXPECT_NEAR(channel.ends.state(0).means.velocity, 1, 0.01) << "that of the rows, of the mean speed 1";
}

TEST(TheLayerOfAnOutlet, HasItsPressureOnTheFluidsLineAndTheFluidsProfile) {
  Setting s = channel();
  s.parameters.outlets[0].pressure = 70;
  Filled channel(s);
  const EquationOfState state{1000, 20, 7, 3e3};
  give(channel, 500, -200);
  channel.ends.impose(channel.fluid, 0, Vec::Zero());
  for (std::size_t i = 0; i < channel.fluid.count; ++i) {
    if (channel.fluid.open_end[i] != 2) continue;
    const double y = channel.fluid.x[1][i];
    EXPECT_NEAR(channel.fluid.v[0][i], 6 * y * (0.5 - y) / 0.25, 0.06);
    EXPECT_NEAR(state.pressure(channel.fluid.rho[i]), 3e3 + 70 - 200 * (channel.fluid.x[0][i] - 2), 1e-6);
  }
}

TEST(Layers, LetSoundOut) {
  Filled channel;
  const EquationOfState state{1000, 20, 7, 3e3};
  give(channel, 0, 0);
  channel.ends.impose(channel.fluid, 0, Vec::Zero());
  // Of 0.001 m/s away from the fluid at both ends: u' and p' = rho c 0.001.
  const double rho_c = 1000 * 20, w = 1e-3;
  for (std::size_t i = 0; i < channel.fluid.count; ++i)
    if (channel.fluid.is_inside(i)) {
      channel.fluid.v[0][i] += channel.fluid.x[0][i] < 1 ? -w : w;
      channel.fluid.rho[i] = state.density(3e3 + rho_c * w);
    }
  channel.ends.impose(channel.fluid, 1, Vec::Zero());  // sound has been through the layers since
  for (int end : {0, 1}) {
    const auto& now = channel.ends.state(static_cast<std::size_t>(end));
    EXPECT_NEAR(now.wave - now.slow_wave, w, 1e-6);
  }
  channel.ends.impose(channel.fluid, 2, Vec::Zero());
  for (std::size_t i = 0; i < channel.fluid.count; ++i) {
    if (channel.fluid.is_inside(i)) continue;
    const double y = channel.fluid.x[1][i], sign = channel.fluid.open_end[i] == 1 ? -1 : 1;
    EXPECT_NEAR(state.pressure(channel.fluid.rho[i]), 3e3 + rho_c * w, 0.01 * rho_c * w);
    EXPECT_NEAR(channel.fluid.v[0][i], 6 * y * (0.5 - y) / 0.25 + sign * w, sign < 0 ? 0.01 * w : 0.06);
  }
}

TEST(Layers, HoldTheSlowPartOfAWave) {
  Filled channel;
  give(channel, 0, 0);
  channel.ends.impose(channel.fluid, 0, Vec::Zero());
  give(channel, 100, 0);
  channel.ends.impose(channel.fluid, 1, Vec::Zero());
  const double wave = channel.ends.state(0).wave, before = channel.ends.state(0).slow_wave;
  EXPECT_NEAR(wave - before, 100 / (2 * 1000 * 20.0), 1e-9);
  channel.ends.count(0.1);  // K = c/(4 L) = 20/8
  EXPECT_NEAR((channel.ends.state(0).slow_wave - before) / (wave - before), 1 - std::exp(-0.25), 1e-9);
}

TEST(OpenChannelRun, KeepsItsBalances) {
  Setting s = channel();
  s.scene.gravity = Vec(0.5, -1);
  s.parameters.laminar_viscosity = LaminarViscosity{5};
  s.parameters.regions[0].velocity = Vec(1, 0);
  WeaklyCompressible solver = s.solver();
  const double mass = solver.mass();
  const Vec momentum = solver.momentum();
  auto row = after(solver, 0.3);
  EXPECT_GT(row["mass_through_inlet"], 100);
  EXPECT_NEAR(solver.mass(), mass + row["mass_through_inlet"] - row["mass_through_outlet"], 1e-9);
  EXPECT_EQ(row["mass"], solver.mass());
  for (const auto& [axis, name] : {std::pair(0, "_x"), std::pair(1, "_y")}) {
    double given = 0, largest = 0;
    for (const auto& [column, value] : row)
      if (column.starts_with("impulse_") && column.ends_with(name)) {
        given += value;
        largest = std::max(largest, std::abs(value));
      }
    EXPECT_NEAR(solver.momentum()[axis], momentum[axis] + given, 1e-12 * largest) << name;
  }
  EXPECT_LT(std::abs(row["energy_remainder"]), 0.01 * row["dissipated_by_viscosity"]);
}

TEST(OpenChannelRun, RestsUnderGravityAcrossIt) {
  Setting s = channel();
  s.scene.gravity = Vec(0, -2);
  s.parameters.hydrostatic_start = HydrostaticStart{0.25};
  s.parameters.inlets.clear();
  s.parameters.outlets.push_back({{"other", Vec(0, 0), Vec(0, 0.5)}, 0, {}});
  WeaklyCompressible solver = s.solver();
  const auto row = after(solver, 1.0);
  EXPECT_LT(row.at("largest_speed"), 0.02) << "a thousandth of the speed of sound";
}

}  // namespace
}  // namespace toryu::fluid
