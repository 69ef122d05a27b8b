/// The coupler's end of the link against a fluid that is written on the bare messages, so that it can say
/// what the participant interface would not: the wrong session, a stale window, other units.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <string>

#include "common/error/machine.hpp"
#include "common/link/coupler_link.hpp"
#include "common/link/dds.hpp"
#include "common/link/process.hpp"
#include "common/link/run_secret.hpp"
#include "common/link/wire.hpp"

namespace toryu {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::size_t particles = 3;
constexpr double time_limit = 20;  // [s], generous: no test waits for it but the one that says so

InterfaceMotion still() {
  const std::vector<double> zero(dim * particles, 0.0);
  return {zero, zero};
}

Interface three_particles() {
  return {{4, 5, 6}, std::vector<double>(dim * particles, 0.5),
          {1, 1, 1}, std::vector<double>(dim * particles, 1.0),
          {2, 2, 2}, 0.1};
}

/// Speaks the fluid's messages without the link's checks.
class RawFluid {
 public:
  std::string process = own_process();
  double reach = 0.25, time_step_limit = 1;

  explicit RawFluid(const std::filesystem::path& out) : node_(dds::rendezvous(out)) {}

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
  dds::Writer<toryu_Hello> hello_{node_, wire::hello};
  dds::Writer<toryu_Status> statuses_{node_, wire::status};
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
    settings.time_limit = time_limit;
    return settings;
  }

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

TEST(Node, IsWokenOnceByAMessageThatNobodyTakes) {
  const auto out = std::filesystem::temp_directory_path() / fmt::format("toryu_node_{}", getpid());
  dds::Node node(dds::rendezvous(out));
  dds::Reader<toryu_Status> reader(node, wire::status);
  dds::Writer<toryu_Status> writer(node, wire::status);
  std::string nothing;
  toryu_Status status{};
  status.reason = nothing.data();
  std::filesystem::remove_all(out);
  writer.write(status);
  EXPECT_TRUE(node.wait(2s));
  EXPECT_FALSE(node.wait(20ms)) << "a loop around it would spin";
  writer.write(status);
  Spin spin;
  SpinningWait waiting(spin);
  EXPECT_TRUE(node.wait(2s, waiting));
  EXPECT_FALSE(node.wait(20ms, waiting)) << "as without spinning";
  EXPECT_TRUE(reader.take([](const toryu_Status&) {})) << "the message is still there";
}

TEST(Node, NamesThePortsThatAreTaken) {
  const auto out = std::filesystem::temp_directory_path() / fmt::format("toryu_ports_{}", getpid());
  const auto place = dds::rendezvous(out);
  std::vector<int> held;
  for (unsigned port = 7400 + 250 * place.domain; port < 7650 + 250 * place.domain; ++port) {
    sockaddr_in self{};
    self.sin_family = AF_INET;
    self.sin_port = htons(static_cast<std::uint16_t>(port));
    self.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    held.push_back(socket(AF_INET, SOCK_DGRAM, 0));
    (void)!bind(held.back(), reinterpret_cast<sockaddr*>(&self),
                sizeof self);  // or another holds it: as good
  }
  EXPECT_THAT([&] { dds::Node{place}; },
              ThrowsMessage<MachineFailure>(
                  testing::AllOf(HasSubstr("free participant index"),
                                 HasSubstr(fmt::format("of {} to {} on 127.0.0.1", 7400 + 250 * place.domain,
                                                       7649 + 250 * place.domain)))));
  for (const int each : held) close(each);
  std::filesystem::remove_all(out);
}

TEST_F(LinkTest, HandshakeCarriesTheInterface) {
  auto solid = start_solid();
  fluid_->say_hello();
  const auto partners = coupler_.gather({});
  EXPECT_EQ(partners.fluid.program, "raw_fluid");
  EXPECT_EQ(partners.solid.program, "solid");
  const auto start = coupler_.begin({});
  EXPECT_EQ(start.traits.reach, 0.25);
  EXPECT_EQ(start.interface.id, three_particles().id);
  EXPECT_EQ(start.interface.area_vector, three_particles().area_vector);
  EXPECT_EQ(start.motion.position, still().position);
  end(ExitCode::physics_failed, "told reason");
  EXPECT_THAT([&] { solid.get(); }, ThrowsMessage<PhysicsFailure>("told reason"));
}

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

TEST_F(LinkTest, ACheckpointIsATurnOfBothAndSaysWhoCouldNot) {
  auto solid = run_one_window();
  const auto fluid = std::async(std::launch::async, [this] { fluid_->fail_checkpoint("no space"); });
  EXPECT_THAT(coupler_.write_checkpoint(window_, "checkpoint/000004"),
              testing::ElementsAre("raw_fluid: no space"));
  EXPECT_EQ(checkpoint_of_solid_, settings_.out / "checkpoint/000004");
  window_.number = 2;
  EXPECT_NO_THROW(coupler_.ask_solid(window_, load_)) << "the run goes on";
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, ACheckpointOfAnotherWindowIsRefused) {
  auto solid = run_one_window();
  const auto fluid = std::async(std::launch::async, [this] { fluid_->fail_checkpoint("", 1); });
  EXPECT_THAT([&] { coupler_.write_checkpoint(window_, "checkpoint/000004"); },
              ThrowsMessage<PeerLost>(HasSubstr("raw_fluid sent window 2 iteration 0 where window 1")));
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, ARunThatGoesOnBeginsWithItsNextWindow) {
  window_.number = 58;
  auto solid = run_one_window({.checkpoints = true, .restart = "checkpoint/000003"});
  EXPECT_EQ(restart_of_solid_, settings_.out / "checkpoint/000003");
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, WhoIsStillAtWorkWhenAWindowIsGrantedComputesFromTheGrant) {
  work_after_answer_ = 200ms;
  auto solid = run_one_window();
  const auto next = [&] {
    ++window_.number;
    return coupler_.ask_solid(window_, load_).health.compute_time;
  };
  EXPECT_GT(next(), 0.15);
  std::this_thread::sleep_for(400ms);
  EXPECT_LT(next(), 0.15) << "it waited for this one";
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, AnInterruptedParticipantIsHeard) {
  auto solid = run_one_window();
  EXPECT_FALSE(coupler_.interrupted());
  fluid_->say(toryu_WAITING, true);
  for (; !coupler_.interrupted() && window_.number < 1000; ++window_.number)
    coupler_.ask_solid({window_.number + 1, 0, 0, 1}, load_);
  EXPECT_TRUE(coupler_.interrupted());
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(LinkTest, AnotherProtocolUnitsAndDimensionAreRefusedTogether) {
  fluid_->say_hello(wire::protocol + 1, "CGS", 3);
  EXPECT_THAT([&] { coupler_.gather({}); },
              ThrowsMessage<BadInput>("raw_fluid: error: protocol is 7, the coupler's is 6\n"
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

TEST_F(LinkTest, ASilentFluidIsNamed) {
  const LinkSettings impatient = impatient_elsewhere("coupler");
  CouplerLink coupler(impatient);
  EXPECT_THAT([&] { coupler.gather({}); },
              ThrowsMessage<PeerLost>("fluid participant did not join within 0.3 s"));
}

/// How a run ends whose fluid, a process of the given name, shows no sign of life any more.
void lose_the_fluid(const LinkSettings& settings, const std::string& process) {
  CouplerLink coupler(settings);
  std::optional<RawFluid> fluid(std::in_place, settings.out);
  fluid->process = process;
  fluid->say_hello();
  const auto lose_it = std::async(std::launch::async, [&] {
    std::this_thread::sleep_for(300ms);
    fluid.reset();
  });
  coupler.gather({});  // in vain, since there is no solid
}

TEST(Lease, OfAProcessThatRunsMayLapse) {
  LinkSettings settings;
  settings.role = "coupler";
  settings.out = std::filesystem::temp_directory_path() / fmt::format("toryu_lease_{}", getpid());
  settings.case_hash = 42;
  settings.time_limit = 30;  // the loss is seen long before, on a busy machine too
  EXPECT_THAT([&] { lose_the_fluid(settings, "another_machine 1 1"); },
              ThrowsMessage<PeerLost>(HasSubstr("raw_fluid was killed or stopped")));
  settings.time_limit = 4;  // longer than a lease and its grace
  EXPECT_THAT([&] { lose_the_fluid(settings, own_process()); },
              ThrowsMessage<PeerLost>("solid participant did not join within 4 s"));
  std::filesystem::remove_all(settings.out);
}

TEST(Death, IsNoticedThoughTheLeaseHolds) {
  LinkSettings settings;
  settings.role = "coupler";
  settings.out = std::filesystem::temp_directory_path() / fmt::format("toryu_death_{}", getpid());
  settings.case_hash = 42;
  settings.time_limit = time_limit;
  CouplerLink coupler(settings);
  RawFluid fluid(settings.out);
  fluid.process = own_process() + "0";  // had this number before, and is gone
  fluid.say_hello();
  EXPECT_THAT([&] { coupler.gather({}); },
              ThrowsMessage<PeerLost>(HasSubstr("raw_fluid was killed or stopped")));
}

TEST_F(LinkTest, AMissingCouplerIsNamed) {
  SolidLink link(impatient_elsewhere("solid"));
  EXPECT_THAT([&] { link.join(); }, ThrowsMessage<PeerLost>("coupler did not come within 0.3 s"));
}

}  // namespace
}  // namespace toryu
