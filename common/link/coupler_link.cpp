#include "common/link/coupler_link.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "common/error/ending.hpp"
#include "common/error/failure.hpp"
#include "common/error/printable.hpp"
#include "common/link/dds.hpp"
#include "common/link/roster.hpp"
#include "common/link/run_secret.hpp"
#include "common/link/session.hpp"
#include "common/link/wire.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"

namespace toryu {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
constexpr auto longest_sleep = 100ms;  // between looks at interruptions and the participants' leases
constexpr auto shutdown_timeout = 3s;  // longest wait for both to hear of the end

/// What is handed to and fro in turns.
struct Turns {
  Turns(dds::Node& node, const Roster& roster)
      : interface_from_solid(node, wire::interface_from_solid, roster.solid().id),
        interface_to_fluid(node, wire::interface_to_fluid),
        motion_to_fluid(node, wire::motion_to_fluid),
        load_from_fluid(node, wire::load_from_fluid, roster.fluid().id),
        load_to_solid(node, wire::load_to_solid),
        motion_from_solid(node, wire::motion_from_solid, roster.solid().id),
        checkpoint_request(node, wire::checkpoint_request),
        checkpoint_from_fluid(node, wire::checkpoint_from_fluid, roster.fluid().id),
        checkpoint_from_solid(node, wire::checkpoint_from_solid, roster.solid().id) {}

  dds::Reader<toryu_Interface> interface_from_solid;
  dds::Writer<toryu_Interface> interface_to_fluid;
  dds::Writer<toryu_Motion> motion_to_fluid;
  dds::Reader<toryu_Load> load_from_fluid;
  dds::Writer<toryu_Load> load_to_solid;
  dds::Reader<toryu_Motion> motion_from_solid;
  dds::Writer<toryu_CheckpointRequest> checkpoint_request;
  dds::Reader<toryu_CheckpointReport> checkpoint_from_fluid, checkpoint_from_solid;
  std::size_t particles = 0;  ///< of the interface
  Spin of_fluid, of_solid;    ///< while they compute
};

}  // namespace

/// Where session, participants and turns meet: waits that look after all of them.
struct CouplerLink::Connection {
  explicit Connection(const LinkSettings& link_settings)
      : settings(link_settings),
        node(dds::rendezvous(settings.out, settings.network), {settings.role, "coupler"}),
        session(node, settings.time_limit),
        roster(node, session, settings),
        turns(node, roster) {}

  LinkSettings settings;
  dds::Node node;
  Session session;
  Roster roster;
  Turns turns;
  Clock::time_point checked = Clock::now();

  void poll();
  void wait(const Participant& awaited, const std::string& what, const std::function<bool()>& arrived);
  template <class Message, class Use>
  void await(dds::Reader<Message>& reader, const Participant& sender, const Window& window, const char* what,
             const Use& use);
  std::vector<std::string> await_parts(const std::filesystem::path& folder);
};

/// Hears the participants, looks after them and after interruptions, and gives a sign of life.
void CouplerLink::Connection::poll() {
  roster.receive();
  if (session.content().phase == toryu_GATHERING) throw_if_interrupted();
  if (session.content().phase == toryu_RUNNING) throw_if_interrupted_again();
  session.heartbeat();
  const auto now = Clock::now();
  if (now - checked < longest_sleep) return;
  if (now - checked > 1s) roster.forgive_silence();  // silence counts only while this side listened
  checked = now;
  node.introductions().hear();
  roster.check_leases(turns.load_from_fluid.live_writers(), turns.motion_from_solid.live_writers());
  if (!session.over()) node.explain_silence();
}

void CouplerLink::Connection::wait(const Participant& awaited, const std::string& what,
                                   const std::function<bool()>& arrived) {
  const auto start = Clock::now();
  SpinningWait waiting(&awaited == &roster.fluid() ? turns.of_fluid : turns.of_solid);
  while (!arrived()) {
    poll();
    if (Clock::now() - std::max(start, awaited.moved) > Seconds(settings.time_limit)) {
      const auto* refusal = awaited.joined() ? nullptr : node.introductions().refusal_of(awaited.part);
      if (refusal != nullptr) throw BadInput({{.place = "--secure", .message = refusal->reason}});
      throw PeerLost(fmt::format("{} {} within {} s", awaited.name(), what, settings.time_limit));
    }
    node.wait(longest_sleep, waiting);
  }
}

/// Waits for the answer of `sender` to `window`, and hands it to `use`. `what` says what it did not do.
template <class Message, class Use>
void CouplerLink::Connection::await(dds::Reader<Message>& reader, const Participant& sender,
                                    const Window& window, const char* what, const Use& use) {
  wait(sender, fmt::format("did not {} in window {}", what, window.number), [&] {
    bool ours = false;
    reader.take([&](const Message& message) {
      ours = message.window.session_id == session.id();
      if (!ours) {
        log::warn("refused window {} of {}'s session {:x}: this run is session {:x}", message.window.number,
                  sender.name(), message.window.session_id, session.id());
        return;
      }
      wire::check(message.window, window, sender.name());
      use(message);
    });
    return ours;
  });
}

/// Waits until the parts that the participants wrote have been brought into `folder`; returns which were not.
std::vector<std::string> CouplerLink::Connection::await_parts(const std::filesystem::path& folder) {
  const auto start = Clock::now();
  for (;;) {
    std::vector<std::string> missing;
    for (const char* part : {"fluid", "solid"})
      if (const auto path = folder / fmt::format("{}.state", part); !std::filesystem::exists(path))
        missing.push_back(fmt::format("'{}' was not brought here within {} s, the time_limit of [coupling]",
                                      path.string(), settings.time_limit));
    if (missing.empty() || Clock::now() - start > Seconds(settings.time_limit)) return missing;
    poll();
    node.wait(longest_sleep);
  }
}

CouplerLink::CouplerLink(const LinkSettings& settings) : connection_(std::make_unique<Connection>(settings)) {
  connection_->session.announce({});
}

CouplerLink::~CouplerLink() {
  stop(ExitCode::bug, "coupler ended before the run was over");
  forget_run_secret(connection_->settings.out);
}

CouplerLink::Partners CouplerLink::gather(const Requirements& requirements) {
  Connection& c = *connection_;
  c.roster.require(requirements);
  for (const Participant* participant : {&c.roster.fluid(), &c.roster.solid()})
    c.wait(*participant, "did not join", [&] { return participant->joined(); });
  return {c.roster.fluid().partner, c.roster.solid().partner};
}

CouplingStart CouplerLink::begin(const Beginning& beginning) {
  Connection& c = *connection_;
  Session::Content content = c.session.content();
  content.phase = toryu_RUNNING;
  content.windows_repeat = c.roster.requirements().windows_repeat;
  content.checkpoints = beginning.checkpoints;
  content.restart = beginning.restart;
  c.session.announce(content);

  const Participant& solid = c.roster.solid();
  CouplingStart start{c.roster.fluid().traits, {}, {}};
  c.wait(solid, "did not register its interface", [&] {
    bool ours = false;
    c.turns.interface_from_solid.take([&](const toryu_Interface& message) {
      ours = message.session_id == c.session.id();
      if (!ours) return;
      start.interface = wire::interface_of(message);
      start.motion = wire::start_of(message);
    });
    return ours;
  });
  wire::check(start.interface, solid.name() + ": interface");
  c.turns.particles = start.interface.size();
  wire::check(start.motion, c.turns.particles, solid.name() + ": motion at the start");
  c.turns.interface_to_fluid.write(wire::interface_message(c.session.id(), start.interface, start.motion));
  return start;
}

void CouplerLink::grant_fluid(const Window& window, const InterfaceMotion& motion) {
  Connection& c = *connection_;
  c.turns.motion_to_fluid.write(wire::motion(wire::window(c.session.id(), window), motion));
}

FluidAnswer CouplerLink::await_fluid(const Window& window) {
  Connection& c = *connection_;
  const Participant& fluid = c.roster.fluid();
  FluidAnswer answer;
  c.await(c.turns.load_from_fluid, fluid, window, "answer", [&](const toryu_Load& message) {
    answer = {wire::load(message), message.time_step_limit, wire::health(message.health)};
  });
  const std::string sender = fmt::format("{}: window {}", fluid.name(), window.number);
  wire::check(answer.load, c.turns.particles, sender);
  wire::check(answer.health, sender);
  if (!(answer.time_step_limit > 0) || !std::isfinite(answer.time_step_limit))
    throw PhysicsFailure(fmt::format("{}: time step limit is {} s", sender, answer.time_step_limit));
  return answer;
}

void CouplerLink::grant_solid(const Window& window, const InterfaceLoad& load) {
  Connection& c = *connection_;
  c.turns.load_to_solid.write(wire::load(wire::window(c.session.id(), window), load));
}

SolidAnswer CouplerLink::await_solid(const Window& window) {
  Connection& c = *connection_;
  const Participant& solid = c.roster.solid();
  SolidAnswer answer;
  c.await(c.turns.motion_from_solid, solid, window, "answer", [&](const toryu_Motion& message) {
    answer = {wire::motion(message), wire::vector(message.impulse_taken), wire::health(message.health)};
  });
  const std::string sender = fmt::format("{}: window {}", solid.name(), window.number);
  wire::check(answer.motion, c.turns.particles, sender);
  wire::check(answer.health, sender);
  if (!answer.impulse_taken.allFinite())
    throw PhysicsFailure(fmt::format("{}: impulse taken is not finite", sender));
  return answer;
}

std::vector<std::string> CouplerLink::write_checkpoint(const Window& window, const std::string& folder) {
  Connection& c = *connection_;
  c.turns.checkpoint_request.write(wire::request_of_checkpoint(wire::window(c.session.id(), window), folder));
  std::vector<std::string> failures;
  const auto await = [&](auto& reader, const Participant& sender) {
    c.await(reader, sender, window, "write its checkpoint", [&](const toryu_CheckpointReport& report) {
      const std::string failure = printable(report.failure);
      if (!failure.empty()) failures.push_back(sender.name() + ": " + failure);
    });
  };
  await(c.turns.checkpoint_from_fluid, c.roster.fluid());
  await(c.turns.checkpoint_from_solid, c.roster.solid());
  if (failures.empty() && c.settings.network.collected) failures = c.await_parts(c.settings.out / folder);
  return failures;
}

bool CouplerLink::interrupted() const {
  return connection_->roster.fluid().interrupted || connection_->roster.solid().interrupted;
}

void CouplerLink::stop(ExitCode code, const std::string& reason) noexcept {
  Connection& c = *connection_;
  if (c.session.over()) return;
  try {
    Session::Content content = c.session.content();
    content.phase = toryu_OVER;
    content.ending = {code, reason};
    c.session.announce(content);
    // Who is late to a run that was refused shall still hear why.
    const auto gone = [&](const Participant& participant) {
      return participant.joined() ? participant.left || participant.dead(c.settings.network.lost_after)
                                  : code != ExitCode::bad_input;
    };
    const Participant &fluid = c.roster.fluid(), &solid = c.roster.solid();
    const auto start = Clock::now();
    while (!(gone(fluid) && gone(solid)) && Clock::now() - start < shutdown_timeout) {
      c.poll();
      c.node.wait(longest_sleep);
    }
    for (const Participant* participant : {&fluid, &solid})
      if (participant->joined() && !gone(*participant))
        log::warn("{} has not confirmed the end of the run", participant->name());
  } catch (const std::exception& failure) {
    log::warn("the participants could not be told of the end: {}", failure.what());
  }
}

void CouplerLink::stop() noexcept {
  const auto [code, reason] = ending_of_exception();
  stop(code, reason);
}

}  // namespace toryu
