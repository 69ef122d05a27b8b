/// A run over the link: handshake, turns, checkpoints, interruption.
#include <arpa/inet.h>
#include <sys/socket.h>

#include <fstream>

#include "common/error/machine.hpp"
#include "link_sides.hpp"

namespace toryu {
namespace {

TEST(Node, IsWokenOnceByAMessageThatNobodyTakes) {
  const auto out = std::filesystem::temp_directory_path() / fmt::format("toryu_node_{}", getpid());
  dds::Node node(dds::rendezvous(out), {"fluid_solver", "fluid"});
  dds::Reader<toryu_Status> reader(node, wire::status_from_fluid);
  dds::Writer<toryu_Status> writer(node, wire::status_from_fluid);
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
  EXPECT_THAT(
      [&] {
        dds::Node(place, {"coupler", "coupler"});
      },
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

/// Sets what the link takes before it is made.
struct Collecting {
  explicit Collecting(bool& collected) : collected_(collected) { collected = true; }
  ~Collecting() { collected_ = false; }
  bool& collected_;
};

class CollectedLinkTest : Collecting, public LinkTest {
 protected:
  CollectedLinkTest() : Collecting(LinkTest::collected) {}

  void bring(const std::string& part) {
    std::ofstream(settings_.out / "checkpoint/000004" / (part + ".state")) << "state";
  }
};

TEST_F(CollectedLinkTest, ACheckpointWaitsForThePartsThatAreBrought) {
  auto solid = run_one_window();
  const auto fluid = std::async(std::launch::async, [this] {
    fluid_->fail_checkpoint("");
    std::this_thread::sleep_for(300ms);
    bring("fluid");
    bring("solid");
  });
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(coupler_.write_checkpoint(window_, "checkpoint/000004"), testing::IsEmpty());
  EXPECT_GT(std::chrono::steady_clock::now() - start, 300ms);
  EXPECT_TRUE(std::filesystem::exists(settings_.out / "checkpoint/000004")) << "the solid made it";
  end(ExitCode::done, "");
  solid.get();
}

TEST_F(CollectedLinkTest, ACheckpointWithoutAPartCostsTheCheckpointAlone) {
  auto solid = run_one_window();
  const auto fluid = std::async(std::launch::async, [this] { fluid_->fail_checkpoint(""); });
  std::filesystem::create_directories(settings_.out / "checkpoint/000004");
  bring("fluid");
  EXPECT_THAT(
      coupler_.write_checkpoint(window_, "checkpoint/000004"),
      testing::ElementsAre(testing::EndsWith("/checkpoint/000004/solid.state' was not brought here within "
                                             "2 s, the time_limit of [coupling]")));
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

}  // namespace
}  // namespace toryu
