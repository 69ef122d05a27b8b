/// The run as the coupler announces it to the participants, again and again as its sign of life.
#pragma once

#include "common/error/ending.hpp"
#include "common/link/dds.hpp"

namespace toryu {

class Session {
 public:
  /// What is announced beside the heartbeat.
  struct Content {
    toryu_Phase phase = toryu_GATHERING;
    std::uint64_t fluid = 0, solid = 0;  ///< the senders that were taken in, 0 before
    double reach = 0;                    ///< of the fluid [m]
    bool windows_repeat = false;
    bool checkpoints = false;
    std::string restart;  ///< checkpoint from which the run goes on, in the results folder
    Ending ending;        ///< of phase over
  };

  /// `time_limit`: the longest silence of a participant [s].
  Session(dds::Node& node, double time_limit);

  std::uint64_t id() const { return id_; }
  const Content& content() const { return content_; }
  bool over() const { return content_.phase == toryu_OVER; }

  void announce(const Content& content);
  /// Announces the same again if the last time is a while ago.
  void heartbeat();

 private:
  using Clock = std::chrono::steady_clock;
  const std::uint64_t id_ = dds::random_id();
  std::string process_;
  double time_limit_;
  dds::Writer<toryu_Session> writer_;
  Content content_;
  std::uint64_t heartbeats_ = 0;
  Clock::time_point announced_{};
};

}  // namespace toryu
