/// Who takes a seat in a run, said in the open: the words by which who is refused is named on both sides.
/// Nothing depends on them but words and how long a program waits: who takes part, DDS Security decides.
#pragma once

#include <dds/dds.h>

#include <chrono>
#include <map>
#include <string>

#include "common/link/identity.hpp"

namespace toryu::dds {

struct Introduction {
  std::string program, process;  ///< of the machine, as words
  std::string part;              ///< that it wants to play
  Credential credential = {};
};

/// This process's own.
Introduction introduction(const std::string& program, const std::string& part, const Network& network);
/// As the user data of a DDS participant.
void introduce(dds_qos_t* participant, const Introduction& own);

/// Hears how the others of the run's domain introduce themselves.
class Introductions {
 public:
  using Clock = std::chrono::steady_clock;
  struct Refusal {
    std::string reason;       ///< "fluid_solver, process 7 of host a: it has no certificate ..."
    Clock::time_point since;  ///< when it was first heard of
  };

  /// Of the domain of `participant`.
  Introductions(dds_entity_t participant, Introduction own);
  /// Hears the news; warns of each that cannot take part.
  void hear();
  /// Why who wanted to play `part` last cannot; nothing if nobody was refused.
  const Refusal* refusal_of(const std::string& part) const;

 private:
  Introduction own_;
  dds_entity_t reader_;
  std::map<std::string, Refusal> refusals_;  // by part
  int told_ = 0;
};

}  // namespace toryu::dds
