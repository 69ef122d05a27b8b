/// The participants as the coupler knows them: who was taken in, whether they move, whether they live.
#pragma once

#include <optional>

#include "common/link/coupler_link.hpp"
#include "common/link/session.hpp"

namespace toryu {

struct Participant {
  using Clock = std::chrono::steady_clock;

  const char* part;  ///< "fluid"
  std::uint64_t id = 0;
  CouplerLink::Partner partner = {};
  std::string process = {};
  FluidTraits traits = {};  ///< of the fluid
  std::uint64_t window = 0, steps = 0;
  Clock::time_point moved = Clock::now();
  std::optional<Clock::time_point> lapsed = {};  ///< since when its lease is over
  bool interrupted = false, left = false;

  bool joined() const { return id != 0; }
  /// Whether its process is gone; or it is not seen to run, and gave no sign of life for so long [s].
  bool dead(double lost_after) const;
  /// Its program's name, or its part while nobody plays it.
  std::string name() const;
};

class Roster {
 public:
  /// `own` says what a participant must agree with.
  Roster(dds::Node& node, Session& session, const LinkSettings& own);

  /// What a participant that joins from now on must be able to do.
  void require(const CouplerLink::Requirements& requirements) { requirements_ = requirements; }
  const CouplerLink::Requirements& requirements() const { return requirements_; }
  /// Hears what the participants say of themselves. Throws BadInput if one does not fit into the run, and
  /// what a participant has ended with.
  void receive();
  /// Looks after their leases, given how many writers of each show signs of life. Throws PeerLost that names
  /// who is dead.
  void check_leases(std::uint32_t fluid_writers, std::uint32_t solid_writers);
  /// Takes no silence so far for one: nobody listened.
  void forgive_silence();

  const Participant& fluid() const { return fluid_; }
  const Participant& solid() const { return solid_; }

 private:
  void accept(const toryu_Hello& hello, Participant& participant);
  void compare(const toryu_Hello& hello, const Participant& participant) const;
  void note(const toryu_Status& status, Participant& participant);

  Session& session_;
  const LinkSettings& own_;
  dds::Reader<toryu_Hello> hellos_of_fluid_, hellos_of_solid_;
  dds::Reader<toryu_Status> statuses_of_fluid_, statuses_of_solid_;
  CouplerLink::Requirements requirements_;
  Participant fluid_{.part = "fluid"}, solid_{.part = "solid"};
};

}  // namespace toryu
