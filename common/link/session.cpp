#include "common/link/session.hpp"

#include "common/link/process.hpp"
#include "common/link/wire.hpp"

namespace toryu {

namespace {

constexpr std::chrono::milliseconds heartbeat_interval{200};

}  // namespace

Session::Session(dds::Node& node, double time_limit)
    : process_(own_process()), time_limit_(time_limit), writer_(node, wire::session) {}

void Session::announce(const Content& content) {
  content_ = content;
  toryu_Session message{};
  message.session_id = id_;
  message.phase = content_.phase;
  message.heartbeat = ++heartbeats_;
  message.process = process_.data();
  message.fluid = content_.fluid;
  message.solid = content_.solid;
  message.reach = content_.reach;
  message.time_limit = time_limit_;
  message.windows_repeat = content_.windows_repeat;
  message.checkpoints = content_.checkpoints;
  message.restart = content_.restart.data();
  message.exit_code = static_cast<std::uint32_t>(content_.ending.code);
  message.reason = content_.ending.reason.data();
  writer_.write(message);
  announced_ = Clock::now();
}

void Session::heartbeat() {
  if (Clock::now() - announced_ > heartbeat_interval) announce(Content(content_));
}

}  // namespace toryu
