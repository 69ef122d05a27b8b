#include "common/link/roster.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error/printable.hpp"
#include "common/link/process.hpp"
#include "common/link/wire.hpp"
#include "common/run/log.hpp"

namespace toryu {

bool Participant::dead(double lost_after) const {
  const ProcessState state = state_of(process);
  if (state == ProcessState::gone) return true;
  return lapsed && Clock::now() - *lapsed > dds::grace(lost_after) && state != ProcessState::runs;
}

std::string Participant::name() const {
  return joined() ? partner.program : fmt::format("{} participant", part);
}

Roster::Roster(dds::Node& node, Session& session, const LinkSettings& own)
    : session_(session),
      own_(own),
      hellos_of_fluid_(node, wire::hello_from_fluid),
      hellos_of_solid_(node, wire::hello_from_solid),
      statuses_of_fluid_(node, wire::status_from_fluid),
      statuses_of_solid_(node, wire::status_from_solid) {}

/// Refuses a participant that computes something else.
void Roster::compare(const toryu_Hello& hello, const Participant& participant) const {
  const std::string& program = participant.partner.program;
  std::vector<InputError> errors;
  const auto must_agree = [&](const char* what, const auto& theirs, const auto& ours) {
    if (theirs != ours)
      errors.push_back(
          {.place = program, .message = fmt::format("{} is {}, the coupler's is {}", what, theirs, ours)});
  };
  must_agree("protocol", hello.protocol, wire::protocol);
  must_agree("hash of the case", fmt::format("{:016x}", hello.case_hash),
             fmt::format("{:016x}", own_.case_hash));
  must_agree("system of units", printable(hello.units), std::string(wire::units));
  if (hello.role != (&participant == &fluid_ ? toryu_FLUID : toryu_SOLID))
    errors.push_back(
        {.place = program, .message = "says of itself that it is not the " + std::string(participant.part)});
  must_agree("dimension", hello.dimension, static_cast<std::uint32_t>(dim));
  const auto must_be_real = [&](const char* trait, double value, const char* unit, bool may_be_zero) {
    if (std::isfinite(value) && (value > 0 || (may_be_zero && value == 0))) return;
    errors.push_back({.place = program,
                      .message = fmt::format("{} is {} {}, and must be a number {}", trait, value, unit,
                                             may_be_zero ? "of at least 0" : "above 0")});
  };
  if (hello.role == toryu_FLUID) {
    must_be_real("reach", hello.reach, "m", false);
    must_be_real("time step limit", hello.time_step_limit, "s", false);
    must_be_real("density", hello.density, "kg/m3", true);
    must_be_real("sound speed", hello.sound_speed, "m/s", true);
    must_be_real("spacing", hello.spacing, "m", true);
  }
  const auto must_be_able = [&](bool asked, bool able, const char* message) {
    if (asked && !able) errors.push_back({.place = program, .message = message});
  };
  must_be_able(requirements_.windows_repeat, hello.can_repeat,
               "cannot repeat a window, which the scheme of the case asks for");
  must_be_able(requirements_.restart, hello.can_checkpoint,
               "cannot go on from a checkpoint, which --restart asks for");
  if (!errors.empty()) throw BadInput(errors);
  if (participant.partner.version != own_.version)
    log::warn("{} is version {}, the coupler {}", program, participant.partner.version, own_.version);
}

void Roster::accept(const toryu_Hello& hello, Participant& participant) {
  if (hello.session_id != 0) return;  // taken in already, by this coupler or by one before it
  if (participant.joined()) {
    if (participant.id != hello.sender)
      log::warn("refused a second {} participant: {}", participant.part, printable(hello.program));
    return;
  }
  participant.partner = {printable(hello.program), printable(hello.version), printable(hello.used_case),
                         hello.can_checkpoint};
  participant.process = hello.process;
  participant.traits = {hello.reach, hello.time_step_limit, hello.density, hello.sound_speed, hello.spacing};
  participant.id = hello.sender;
  participant.moved = Participant::Clock::now();
  if (session_.over()) return;
  compare(hello, participant);
  log::info("{} {} joined as the {}", participant.partner.program, participant.partner.version,
            participant.part);
  Session::Content content = session_.content();
  content.fluid = fluid_.id;
  content.solid = solid_.id;
  content.reach = fluid_.traits.reach;
  session_.announce(content);
}

void Roster::note(const toryu_Status& status, Participant& participant) {
  // Of a refused participant, or of another run; 0 is of one that left before it knew ours.
  if (status.sender != participant.id || (status.session_id != session_.id() && status.session_id != 0))
    return;
  const bool moved = status.steps != participant.steps || status.window != participant.window;
  if (moved) participant.moved = Participant::Clock::now();
  participant.steps = status.steps;
  participant.window = status.window;
  participant.interrupted = participant.interrupted || status.interrupted;
  if (status.activity != toryu_LEFT) return;
  participant.left = true;
  if (session_.over()) return;
  const auto code = static_cast<ExitCode>(status.exit_code);
  const std::string reason =
      code == ExitCode::done ? "left before the end of the run" : printable(status.reason);
  throw_ending({code, fmt::format("{}: {}", participant.name(), reason)});
}

void Roster::receive() {
  const auto hear = [this](auto& statuses, auto& hellos, Participant& participant) {
    while (statuses.take([&](const toryu_Status& status) { note(status, participant); })) {
    }
    while (hellos.take([&](const toryu_Hello& hello) { accept(hello, participant); })) {
    }
  };
  hear(statuses_of_fluid_, hellos_of_fluid_, fluid_);
  hear(statuses_of_solid_, hellos_of_solid_, solid_);
}

void Roster::check_leases(std::uint32_t fluid_writers, std::uint32_t solid_writers) {
  const auto check = [](Participant& participant, std::uint32_t live_writers) {
    if (!participant.joined() || live_writers > 0)
      participant.lapsed = {};
    else if (!participant.lapsed)
      participant.lapsed = Participant::Clock::now();
  };
  check(fluid_, fluid_writers);
  check(solid_, solid_writers);
  if (session_.over()) return;
  for (const Participant* participant : {&fluid_, &solid_}) {
    if (!participant->joined() || !participant->dead(own_.network.lost_after)) continue;
    receive();  // its last words say more, and may have come since they were looked for
    throw PeerLost(fmt::format("{} {}: no sign of life in window {}", participant->name(),
                               words_of_loss(participant->process), participant->window));
  }
}

void Roster::forgive_silence() {
  fluid_.moved = solid_.moved = Participant::Clock::now();
}

}  // namespace toryu
