/// A coupler's end of the link with a solid of the participant interface, and a fluid that is written on the
/// bare messages, so that it can say what that interface would not: the wrong session, a stale window, other
/// units.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include "common/link/coupler_link.hpp"
#include "common/link/dds.hpp"
#include "common/link/process.hpp"
#include "common/link/run_secret.hpp"
#include "common/link/wire.hpp"

namespace toryu {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::size_t particles = 3;
constexpr double time_limit = 20;  // [s], generous: no test waits for it but the one that says so

inline InterfaceMotion still() {
  const std::vector<double> zero(dim * particles, 0.0);
  return {zero, zero};
}

inline Interface three_particles() {
  return {{4, 5, 6}, std::vector<double>(dim * particles, 0.5),
          {1, 1, 1}, std::vector<double>(dim * particles, 1.0),
          {2, 2, 2}, 0.1};
}

/// Speaks the fluid's messages without the link's checks.
class RawFluid {
 public:
  std::string process = own_process();
  double reach = 0.25, time_step_limit = 1;

  explicit RawFluid(const std::filesystem::path& out) : node_(dds::rendezvous(out), {"raw_fluid", "fluid"}) {}

  void say_hello(std::uint32_t protocol = wire::protocol, std::string units = wire::units,
                 std::uint32_t dimension = dim) {
    std::string program = "raw_fluid", nothing;
    toryu_Hello hello{};
    hello.role = toryu_FLUID;
    hello.program = program.data();
    hello.version = nothing.data();
    hello.process = process.data();
    hello.protocol = protocol;
    hello.case_hash = 42;
    hello.units = units.data();
    hello.dimension = dimension;
    hello.reach = reach;
    hello.time_step_limit = time_step_limit;
    hello.used_case = nothing.data();
    hello_.write(hello);
  }

  void say(toryu_Activity activity, bool interrupted = false) {
    std::string nothing;
    toryu_Status status{};
    status.interrupted = interrupted;
    status.activity = activity;
    status.reason = nothing.data();
    statuses_.write(status);
  }

  /// Waits for the grant of a window and returns its head.
  toryu_WindowHead await_window() {
    toryu_WindowHead head{};
    while (!motions_.take([&](const toryu_Motion& motion) { head = motion.window; })) node_.wait(50ms);
    return head;
  }

  /// Waits for the request of a checkpoint and says that it failed, as of `skew` windows later.
  void fail_checkpoint(std::string failure, std::uint64_t skew = 0) {
    toryu_WindowHead head{};
    const auto take = [&](const toryu_CheckpointRequest& request) { head = request.window; };
    while (!checkpoint_requests_.take(take)) node_.wait(50ms);
    head.number += skew;
    checkpoint_reports_.write(wire::report_of_checkpoint(head, failure));
  }

  void answer(const toryu_WindowHead& head, double pressure = 1) {
    const InterfaceLoad load{
        std::vector<double>(particles, pressure), std::vector<double>(dim * particles, 1.0), {}, Vec::Zero()};
    toryu_Load message = wire::load(head, load);
    message.time_step_limit = 1;
    loads_.write(message);
  }

  /// Answers with a load of which a bit was flipped on its way.
  void answer_damaged(const toryu_WindowHead& head) {
    const InterfaceLoad load{
        std::vector<double>(particles, 1.0), std::vector<double>(dim * particles, 1.0), {}, Vec::Zero()};
    toryu_Load message = wire::load(head, load);
    message.time_step_limit = 1;
    message.sender = node_.id();
    message.seal = dds::seal_of(message, node_.key()) ^ 1;
    const auto writer = node_.make_writer(toryu_Load_desc, wire::load_from_fluid);
    dds::require(dds_write(writer, &message), wire::load_from_fluid);
  }

 private:
  dds::Node node_;
  dds::Writer<toryu_Hello> hello_{node_, wire::hello_from_fluid};
  dds::Writer<toryu_Status> statuses_{node_, wire::status_from_fluid};
  dds::Reader<toryu_Motion> motions_{node_, wire::motion_to_fluid};
  dds::Writer<toryu_Load> loads_{node_, wire::load_from_fluid};
  dds::Reader<toryu_CheckpointRequest> checkpoint_requests_{node_, wire::checkpoint_request};
  dds::Writer<toryu_CheckpointReport> checkpoint_reports_{node_, wire::checkpoint_from_fluid};
};

class LinkTest : public testing::Test {
 protected:
  LinkTest() { settings_.role = "coupler"; }
  ~LinkTest() override {
    end(ExitCode::interrupted, "end of the test");
    for (const auto& folder : {settings_.out, elsewhere_}) std::filesystem::remove_all(folder);
  }

  void end(ExitCode code, const std::string& reason) {
    if (fluid_) fluid_->say(toryu_LEFT);
    coupler_.stop(code, reason);
  }

  static LinkSettings settings_for(const std::string& role) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    LinkSettings settings;
    settings.role = role;
    settings.out =
        std::filesystem::temp_directory_path() / fmt::format("toryu_{}_{}", test->name(), getpid());
    settings.case_hash = 42;
    settings.time_limit = collected ? 2 : time_limit;
    settings.network.collected = collected;
    return settings;
  }

  static inline bool collected = false;  ///< whether parts of checkpoints are brought to the coupler

  /// Where nobody else is. The domain is another than the coupler's, since a process makes each only once:
  /// one secret in 100 has the same, and there a test would find the coupler.
  LinkSettings impatient_elsewhere(const std::string& role) {
    LinkSettings settings = settings_for(role);
    const auto domain = [](const auto& out) { return dds::rendezvous(out).domain; };
    settings.out = elsewhere_ = settings.out.string() + "_elsewhere";
    while (domain(settings.out) == domain(settings_.out)) forget_run_secret(settings.out);
    settings.time_limit = 0.3;
    return settings;
  }

  /// A solid that joins, answers every window with rest, and ends as the coupler says.
  std::future<void> start_solid() {
    return std::async(std::launch::async, [this] {
      SolidLink link(settings_for("solid"));
      EXPECT_EQ(link.join(), 0.25);
      restart_of_solid_ = link.restart();
      link.register_interface(three_particles(), still());
      while (const auto turn = link.next_turn()) {
        if (turn->task == Task::window) {
          link.send(still(), Vec::Zero(), {});
          std::this_thread::sleep_for(work_after_answer_);
        } else
          link.confirm_checkpoint([&] { checkpoint_of_solid_ = turn->checkpoint; });
      }
    });
  }

  /// Both joined, and a first window computed by the solid.
  std::future<void> run_one_window(const CouplerLink::Beginning& beginning = {}) {
    auto solid = start_solid();
    fluid_->say_hello();
    coupler_.gather({});
    coupler_.begin(beginning);
    coupler_.ask_solid(window_, load_);
    return solid;
  }

  Window window_{.number = 1, .iteration = 0, .time = 0, .dt = 1};
  InterfaceLoad load_{
      std::vector<double>(particles, 1.0), std::vector<double>(dim* particles, 1.0), {}, Vec::Zero()};
  std::filesystem::path elsewhere_;
  std::filesystem::path restart_of_solid_, checkpoint_of_solid_;
  std::chrono::milliseconds work_after_answer_{0};  // of the solid
  LinkSettings settings_ = settings_for("coupler");
  CouplerLink coupler_{settings_};
  std::optional<RawFluid> fluid_{std::in_place, settings_.out};
};

}  // namespace toryu
