/// What the coupler's end of the link does not take: messages of others, damaged ones, partners that do not
/// fit.
#include <atomic>

#include "link_sides.hpp"

namespace toryu {
namespace {

TEST_F(LinkTest, AnswerToAStaleWindowIsRefused) {
  auto solid = start_solid();
  fluid_->say_hello();
  coupler_.gather({});
  const auto start = coupler_.begin({});
  const auto fluid = std::async(std::launch::async, [this] {
    auto head = fluid_->await_window();
    --head.number;
    fluid_->answer(head);
  });
  EXPECT_THAT([&] { coupler_.ask_fluid({.number = 1, .iteration = 0, .time = 0, .dt = 1}, start.motion); },
              ThrowsMessage<PeerLost>(HasSubstr("raw_fluid sent window 0 iteration 0 where window 1")));
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, MessageOfAnotherSessionIsPassedOver) {
  auto solid = start_solid();
  fluid_->say_hello();
  coupler_.gather({});
  const auto start = coupler_.begin({});
  std::atomic<bool> answered_rightly = false;
  const auto fluid = std::async(std::launch::async, [&] {
    const auto head = fluid_->await_window();
    auto of_another_run = head;
    of_another_run.session_id += 1;
    fluid_->answer(of_another_run);
    std::this_thread::sleep_for(300ms);  // so that the coupler has met the wrong one
    answered_rightly = true;
    fluid_->answer(head);
  });
  coupler_.ask_fluid({.number = 1, .iteration = 0, .time = 0, .dt = 1}, start.motion);
  EXPECT_TRUE(answered_rightly);
  end(ExitCode::done, "");
  solid.get();
}

/// Another process with the secret and the id of the run, which answers in the fluid's place.
TEST_F(LinkTest, AStrangerNeitherAnswersNorDisplacesAnAnswer) {
  auto solid = start_solid();
  fluid_->say_hello();
  coupler_.gather({});
  const auto start = coupler_.begin({});
  RawFluid stranger(settings_.out);
  for (window_.number = 1; window_.number <= 3; ++window_.number) {
    const auto fluid = std::async(std::launch::async, [&] {
      const auto head = fluid_->await_window();
      for (int k = 0; k < 50; ++k) stranger.answer(head, 666);
      fluid_->answer(head, 7);
      for (int k = 0; k < 50; ++k) stranger.answer(head, 666);
    });
    coupler_.grant_fluid(window_, start.motion);
    fluid.wait();
    EXPECT_EQ(coupler_.await_fluid(window_).load.pressure, std::vector<double>(particles, 7.0));
  }
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, ADamagedAnswerEndsTheRun) {
  auto solid = start_solid();
  fluid_->say_hello();
  coupler_.gather({});
  const auto start = coupler_.begin({});
  const auto fluid = std::async(std::launch::async, [&] { fluid_->answer_damaged(fluid_->await_window()); });
  EXPECT_THAT([&] { coupler_.ask_fluid(window_, start.motion); },
              ThrowsMessage<PeerLost>(HasSubstr("a message of 'toryu/load_from_fluid' was damaged")));
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, AnotherProtocolUnitsAndDimensionAreRefusedTogether) {
  fluid_->say_hello(wire::protocol + 1, "CGS", 3);
  EXPECT_THAT([&] { coupler_.gather({}); },
              ThrowsMessage<BadInput>("raw_fluid: error: protocol is 8, the coupler's is 7\n"
                                      "raw_fluid: error: system of units is CGS, the coupler's is SI\n"
                                      "raw_fluid: error: dimension is 3, the coupler's is 2"));
}

TEST_F(LinkTest, TraitsThatAreNoneAreRefusedByName) {
  fluid_->reach = std::numeric_limits<double>::quiet_NaN();
  fluid_->time_step_limit = 0;
  fluid_->say_hello();
  EXPECT_THAT(
      [&] { coupler_.gather({}); },
      ThrowsMessage<BadInput>("raw_fluid: error: reach is nan m, and must be a number above 0\n"
                              "raw_fluid: error: time step limit is 0 s, and must be a number above 0"));
}

}  // namespace
}  // namespace toryu
