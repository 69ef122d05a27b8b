#include "common/link/coupler_link.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include "common/error/ending.hpp"
#include "common/error/failure.hpp"
#include "common/link/dds.hpp"
#include "common/link/process.hpp"
#include "common/link/wire.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"

namespace toryu {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
constexpr auto longest_sleep = 100ms;  // between looks at interruptions and the peers' leases
constexpr auto beat_interval = 200ms;
constexpr auto shutdown_timeout = 3s;  // longest wait for both to hear of the end

/// What the coupler knows of a participant.
struct Participant {
  const char* part;  ///< "fluid"
  std::uint64_t id = 0;
  CouplerLink::Partner partner = {};
  std::string process = {};
  FluidTraits traits = {};  ///< of the fluid
  std::uint64_t window = 0, steps = 0;
  Clock::time_point moved = Clock::now();
  std::optional<Clock::time_point> lapsed = {};  ///< since when its lease is over
  bool left = false;

  bool joined() const { return id != 0; }
  bool dead() const { return lapsed && Clock::now() - *lapsed > dds::grace && !runs_here(process); }
  /// Its program's name, or its part while nobody plays it.
  std::string name() const { return joined() ? partner.program : fmt::format("{} participant", part); }
};

}  // namespace

struct CouplerLink::Connection {
  explicit Connection(const LinkSettings& link_settings)
      : settings(link_settings), node(dds::rendezvous(settings.out)) {}

  LinkSettings settings;
  const std::uint64_t session = dds::random_id();
  std::string process = own_process();
  dds::Node node;
  dds::Writer<toryu_Session> sessions{node, wire::session};
  dds::Reader<toryu_Hello> hellos{node, wire::hello};
  dds::Reader<toryu_Status> statuses{node, wire::status};
  dds::Reader<toryu_Interface> interfaces{node, wire::interface_from_solid};
  dds::Writer<toryu_Interface> interfaces_on{node, wire::interface_to_fluid};
  dds::Writer<toryu_Motion> motions{node, wire::motion_to_fluid};
  dds::Reader<toryu_Load> loads{node, wire::load_from_fluid};
  dds::Writer<toryu_Load> loads_on{node, wire::load_to_solid};
  dds::Reader<toryu_Motion> motions_back{node, wire::motion_from_solid};

  Participant fluid{.part = "fluid"}, solid{.part = "solid"};
  toryu_Phase phase = toryu_GATHERING;
  ExitCode code = ExitCode::done;
  std::string reason;
  std::uint64_t beat = 0;
  bool windows_repeat = false;
  std::size_t particles = 0;
  Clock::time_point beaten{}, checked = Clock::now();

  void announce();
  void welcome(const toryu_Hello& hello);
  void compare(const toryu_Hello& hello, const Participant& guest);
  void note(const toryu_Status& status);
  void listen();
  void check_lease(Participant& guest, std::uint32_t live_writers);
  void poll();
  void wait(const Participant& awaited, const std::string& what, const std::function<bool()>& arrived);
  bool ours(const toryu_WindowHead& window, const Participant& sender) const;
};

void CouplerLink::Connection::announce() {
  toryu_Session message{};
  message.session_id = session;
  message.phase = phase;
  message.beat = ++beat;
  message.process = process.data();
  message.fluid = fluid.id;
  message.solid = solid.id;
  message.reach = fluid.traits.reach;
  message.time_limit = settings.time_limit;
  message.windows_repeat = windows_repeat;
  message.exit_code = static_cast<std::uint32_t>(code);
  message.reason = reason.data();
  sessions.write(message);
  beaten = Clock::now();
}

/// Refuses a participant that computes something else.
void CouplerLink::Connection::compare(const toryu_Hello& hello, const Participant& guest) {
  std::vector<InputError> errors;
  const auto must_agree = [&](const char* what, const auto& theirs, const auto& ours_) {
    if (theirs != ours_)
      errors.push_back({.place = guest.partner.program,
                        .message = fmt::format("{} is {}, the coupler's is {}", what, theirs, ours_)});
  };
  must_agree("protocol", hello.protocol, wire::protocol);
  must_agree("hash of the case", fmt::format("{:016x}", hello.case_hash),
             fmt::format("{:016x}", settings.case_hash));
  must_agree("system of units", std::string(hello.units), std::string(wire::units));
  must_agree("dimension", hello.dimension, static_cast<std::uint32_t>(dim));
  if (windows_repeat && !hello.can_repeat)
    errors.push_back({.place = guest.partner.program,
                      .message = "cannot repeat a window, which the scheme of the case asks for"});
  if (!errors.empty()) throw BadInput(errors);
  if (guest.partner.version != settings.version)
    log::warn("{} is version {}, the coupler {}", guest.partner.program, guest.partner.version,
              settings.version);
}

void CouplerLink::Connection::welcome(const toryu_Hello& hello) {
  if (hello.session_id != 0) return;  // taken in already, by this coupler or by one before it
  Participant& guest = hello.role == toryu_FLUID ? fluid : solid;
  if (guest.joined()) {
    if (guest.id != hello.sender) log::warn("refused a second {} participant: {}", guest.part, hello.program);
    return;
  }
  guest.partner = {hello.program, hello.version, hello.used_case};
  guest.process = hello.process;
  guest.traits = {hello.reach, hello.time_step_limit, hello.density, hello.sound_speed, hello.spacing};
  guest.id = hello.sender;
  guest.moved = Clock::now();
  if (phase == toryu_OVER) return;
  compare(hello, guest);
  log::info("{} {} joined as the {}", guest.partner.program, guest.partner.version, guest.part);
  if (fluid.joined() && solid.joined()) phase = toryu_RUNNING;
  announce();
}

void CouplerLink::Connection::note(const toryu_Status& status) {
  Participant* guest = status.sender == fluid.id ? &fluid : status.sender == solid.id ? &solid : nullptr;
  // Of a refused participant, or of another run; 0 is of one that left before it knew ours.
  if (guest == nullptr || (status.session_id != session && status.session_id != 0)) return;
  const bool moved = status.steps != guest->steps || status.window != guest->window;
  if (moved) guest->moved = Clock::now();
  guest->steps = status.steps;
  guest->window = status.window;
  if (status.activity != toryu_LEFT) return;
  guest->left = true;
  if (phase == toryu_OVER) return;
  const auto their_code = static_cast<ExitCode>(status.exit_code);
  const std::string words = their_code == ExitCode::done ? "left before the end of the run" : status.reason;
  throw_ending({their_code, fmt::format("{}: {}", guest->name(), words)});
}

void CouplerLink::Connection::listen() {
  while (statuses.take([this](const toryu_Status& status) { note(status); })) {
  }
  while (hellos.take([this](const toryu_Hello& hello) { welcome(hello); })) {
  }
}

void CouplerLink::Connection::check_lease(Participant& guest, std::uint32_t live_writers) {
  if (!guest.joined() || live_writers > 0)
    guest.lapsed = {};
  else if (!guest.lapsed)
    guest.lapsed = Clock::now();
}

/// Hears the participants, looks after them and after interruptions, and gives a sign of life.
void CouplerLink::Connection::poll() {
  listen();
  if (phase != toryu_OVER) throw_if_interrupted();
  const auto now = Clock::now();
  if (now - beaten > beat_interval) announce();
  if (now - checked < longest_sleep) return;
  if (now - checked > 1s) fluid.moved = solid.moved = now;  // silence counts only while this side listened
  checked = now;
  check_lease(fluid, loads.live_writers());
  check_lease(solid, motions_back.live_writers());
  if (phase == toryu_OVER) return;
  node.check_quality();
  for (const Participant* guest : {&fluid, &solid})
    if (guest->dead())
      throw PeerLost(fmt::format("{} was killed or stopped: no sign of life in window {}", guest->name(),
                                 guest->window));
}

void CouplerLink::Connection::wait(const Participant& awaited, const std::string& what,
                                   const std::function<bool()>& arrived) {
  const auto start = Clock::now();
  while (!arrived()) {
    poll();
    if (Clock::now() - std::max(start, awaited.moved) > Seconds(settings.time_limit))
      throw PeerLost(fmt::format("{} {} within {} s", awaited.name(), what, settings.time_limit));
    node.wait(longest_sleep);
  }
}

bool CouplerLink::Connection::ours(const toryu_WindowHead& window, const Participant& sender) const {
  if (window.session_id == session) return true;
  log::warn("refused window {} of {}'s session {:x}: this run is session {:x}", window.number, sender.name(),
            window.session_id, session);
  return false;
}

CouplerLink::CouplerLink(const LinkSettings& settings) : connection_(std::make_unique<Connection>(settings)) {
  connection_->announce();
}

CouplerLink::~CouplerLink() {
  stop(ExitCode::bug, "coupler ended before the run was over");
}

CouplerLink::Start CouplerLink::gather(bool windows_repeat) {
  Connection& c = *connection_;
  c.windows_repeat = windows_repeat;
  for (const Participant* guest : {&c.fluid, &c.solid})
    c.wait(*guest, "did not join", [&] { return guest->joined(); });
  Start start{c.fluid.partner, c.solid.partner, c.fluid.traits, {}, {}};
  c.wait(c.solid, "did not register its interface", [&] {
    bool mine = false;
    c.interfaces.take([&](const toryu_Interface& message) {
      mine = message.session_id == c.session;
      if (!mine) return;
      start.interface = wire::interface_of(message);
      start.motion = wire::start_of(message);
    });
    return mine;
  });
  wire::check(start.interface, c.solid.name() + ": interface");
  c.particles = start.interface.size();
  wire::check(start.motion, c.particles, c.solid.name() + ": motion at the start");
  c.interfaces_on.write(wire::interface_message(c.session, start.interface, start.motion));
  return start;
}

void CouplerLink::grant_fluid(const Window& window, const InterfaceMotion& motion) {
  Connection& c = *connection_;
  c.motions.write(wire::motion(wire::window(c.session, window), motion));
}

CouplerLink::FluidAnswer CouplerLink::await_fluid(const Window& window) {
  Connection& c = *connection_;
  FluidAnswer answer;
  c.wait(c.fluid, fmt::format("did not answer in window {}", window.number), [&] {
    bool mine = false;
    c.loads.take([&](const toryu_Load& message) {
      mine = c.ours(message.window, c.fluid);
      if (!mine) return;
      wire::check(message.window, window, c.fluid.name());
      answer = {wire::load(message), message.time_step_limit, wire::health(message.health)};
    });
    return mine;
  });
  const std::string sender = fmt::format("{}: window {}", c.fluid.name(), window.number);
  wire::check(answer.load, c.particles, sender);
  if (!(answer.time_step_limit > 0) || !std::isfinite(answer.time_step_limit))
    throw PhysicsFailure(fmt::format("{}: time step limit is {} s", sender, answer.time_step_limit));
  return answer;
}

void CouplerLink::grant_solid(const Window& window, const InterfaceLoad& load) {
  Connection& c = *connection_;
  c.loads_on.write(wire::load(wire::window(c.session, window), load));
}

CouplerLink::SolidAnswer CouplerLink::await_solid(const Window& window) {
  Connection& c = *connection_;
  SolidAnswer answer;
  c.wait(c.solid, fmt::format("did not answer in window {}", window.number), [&] {
    bool mine = false;
    c.motions_back.take([&](const toryu_Motion& message) {
      mine = c.ours(message.window, c.solid);
      if (!mine) return;
      wire::check(message.window, window, c.solid.name());
      answer = {wire::motion(message), wire::vector(message.impulse_taken), wire::health(message.health)};
    });
    return mine;
  });
  const std::string sender = fmt::format("{}: window {}", c.solid.name(), window.number);
  wire::check(answer.motion, c.particles, sender);
  if (!answer.impulse_taken.allFinite())
    throw PhysicsFailure(fmt::format("{}: impulse taken is not finite", sender));
  return answer;
}

void CouplerLink::stop(ExitCode code, const std::string& reason) noexcept {
  Connection& c = *connection_;
  if (c.phase == toryu_OVER) return;
  c.phase = toryu_OVER;
  c.code = code;
  c.reason = reason;
  try {
    c.announce();
    // Who is late to a run that was refused shall still hear why.
    const auto gone = [&](const Participant& guest) {
      return guest.joined() ? guest.left || guest.dead() : code != ExitCode::bad_input;
    };
    const auto start = Clock::now();
    while (!(gone(c.fluid) && gone(c.solid)) && Clock::now() - start < shutdown_timeout) {
      c.poll();
      c.node.wait(longest_sleep);
    }
    for (const Participant* guest : {&c.fluid, &c.solid})
      if (guest->joined() && !gone(*guest))
        log::warn("{} has not confirmed the end of the run", guest->name());
  } catch (const std::exception& failure) {
    log::warn("the participants could not be told of the end: {}", failure.what());
  }
}

void CouplerLink::stop() noexcept {
  const auto [code, reason] = ending_of_exception();
  stop(code, reason);
}

}  // namespace toryu
