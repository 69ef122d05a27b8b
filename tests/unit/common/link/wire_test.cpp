/// What is checked of each message before it is used, and how endings travel.
#include "common/link/wire.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <limits>

#include "common/error/ending.hpp"

namespace toryu {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const double nan = std::numeric_limits<double>::quiet_NaN();

InterfaceMotion motion_of_two() {
  return {{1, 2, 3, 4}, {5, 6, 7, 8}};
}

TEST(Wire, MotionSurvives) {
  const auto sent = motion_of_two();
  const auto message =
      wire::motion(wire::window(7, {.number = 3, .iteration = 0, .time = 0.5, .dt = 0.25}), sent);
  const auto received = wire::motion(message);
  EXPECT_EQ(received.position, sent.position);
  EXPECT_EQ(received.velocity, sent.velocity);
  const Window window = wire::window(message.window);
  EXPECT_EQ(window.number, 3u);
  EXPECT_EQ(window.time, 0.5);
  EXPECT_EQ(window.dt, 0.25);
}

TEST(Wire, VectorsArePaddedToThreeComponents) {
  double components[3] = {9, 9, 9};
  wire::set(components, Vec(1, 2));
  EXPECT_THAT(components, testing::ElementsAre(1, 2, 0));
  EXPECT_EQ(wire::vector(components), Vec(1, 2));
}

TEST(WireCheck, NamesWhatIsNotFinite) {
  auto motion = motion_of_two();
  motion.velocity[3] = nan;
  EXPECT_THAT(
      [&] { wire::check(motion, 2, "solid_solver: window 12"); },
      ThrowsMessage<PhysicsFailure>("solid_solver: window 12: velocity of interface particle 1 is nan"));
}

TEST(WireCheck, NamesAWrongCount) {
  auto motion = motion_of_two();
  motion.velocity.pop_back();
  EXPECT_THAT([&] { wire::check(motion, 2, "solid_solver: window 12"); },
              ThrowsMessage<PeerLost>("solid_solver: window 12: 3 values of velocity came, 4 were awaited"));
}

Interface interface_of_two() {
  return {.id = {4, 9},
          .position = {0, 0, 1, 0},
          .volume = {1, 1},
          .area_vector = {0, 0, 0, 1},
          .mass = {2, 2},
          .spacing = 1};
}

TEST(WireCheck, ParticlesOfTheInterfaceHaveVolumesAndMassesAboveZero) {
  EXPECT_NO_THROW(wire::check(interface_of_two(), "my_solid"));
  for (const double value : {0.0, -0.0, -2.0}) {
    auto interface = interface_of_two();
    interface.volume[1] = value;
    EXPECT_THAT([&] { wire::check(interface, "my_solid"); },
                ThrowsMessage<PeerLost>(
                    fmt::format("my_solid: volume of interface particle 1 is {}, not above 0", value)));
    interface = interface_of_two();
    interface.mass[0] = value;
    EXPECT_THAT([&] { wire::check(interface, "my_solid"); },
                ThrowsMessage<PeerLost>(
                    fmt::format("my_solid: mass of interface particle 0 is {}, not above 0", value)));
  }
  auto interface = interface_of_two();
  interface.mass[1] = nan;
  EXPECT_THAT([&] { wire::check(interface, "my_solid"); },
              ThrowsMessage<PhysicsFailure>("my_solid: mass of interface particle 1 is nan"));
  interface.mass.pop_back();
  EXPECT_THAT([&] { wire::check(interface, "my_solid"); },
              ThrowsMessage<PeerLost>("my_solid: 1 values of mass came, 2 were awaited"));
}

TEST(WireCheck, SpacingOfTheInterfaceIsFiniteAndAboveZero) {
  for (const double value : {0.0, -1.0, std::numeric_limits<double>::infinity(), nan}) {
    auto interface = interface_of_two();
    interface.spacing = value;
    EXPECT_THAT([&] { wire::check(interface, "my_solid"); },
                ThrowsMessage<PeerLost>(
                    fmt::format("my_solid: spacing {} of the interface is not finite and above 0", value)));
  }
}

TEST(WireCheck, LoadMayLackFrictionButNotHaveHalfOfIt) {
  InterfaceLoad load{{1, 2}, {1, 2, 3, 4}, {}, Vec::Zero()};
  EXPECT_NO_THROW(wire::check(load, 2, "x"));
  load.friction_force = {1, 2};
  EXPECT_THAT([&] { wire::check(load, 2, "x"); }, ThrowsMessage<PeerLost>(HasSubstr("friction force")));
  load.friction_force.clear();
  load.impulse_on_fluid.x() = nan;
  EXPECT_THAT([&] { wire::check(load, 2, "x"); }, ThrowsMessage<PhysicsFailure>(HasSubstr("impulse")));
}

TEST(WireCheck, NamesAHealthThatIsNotFinite) {
  EXPECT_NO_THROW(wire::check(Health{}, "x"));
  Health health;
  health.momentum.y() = nan;
  EXPECT_THAT([&] { wire::check(health, "solid_solver: window 12"); },
              ThrowsMessage<PhysicsFailure>(HasSubstr("solid_solver: window 12: an energy, the momentum")));
}

TEST(WireCheck, RefusesAStaleWindow) {
  const auto sent = wire::window(1, {.number = 6, .iteration = 0, .time = 0, .dt = 1});
  EXPECT_THAT([&] { wire::check(sent, {.number = 7}, "fluid_solver"); },
              ThrowsMessage<PeerLost>(
                  "fluid_solver sent window 6 iteration 0 where window 7 iteration 0 was awaited"));
}

TEST(WireCheck, RefusesAWindowWithoutLength) {
  const auto sent = wire::window(1, {.number = 7, .iteration = 0, .time = 0, .dt = 0});
  EXPECT_THROW(wire::check(sent, {.number = 7}, "coupler"), PhysicsFailure);
}

TEST(Ending, ComesOutAsItWentIn) {
  for (const ExitCode code : {ExitCode::bad_input, ExitCode::physics_failed, ExitCode::peer_lost,
                              ExitCode::machine, ExitCode::interrupted}) {
    try {
      throw_ending({code, "why"});
    } catch (...) {
      const Ending ending = ending_of_exception();
      EXPECT_EQ(ending.code, code);
      EXPECT_THAT(ending.reason, HasSubstr("why"));
    }
  }
}

TEST(Ending, OfABugElsewhereIsALostPeer) {
  EXPECT_THROW(throw_ending({ExitCode::bug, "why"}), PeerLost);
}

}  // namespace
}  // namespace toryu
