/// A participant's connection to the coupler: the handshake, signs of life both ways, waits with a limit.
/// FluidLink and SolidLink add the messages of their side.
#pragma once

#include <functional>

#include "common/link/dds.hpp"
#include "common/link/participant.hpp"
#include "common/link/wire.hpp"

namespace toryu {

class Connection {
 public:
  Connection(const LinkSettings& settings, toryu_Role role);
  ~Connection();

  /// Introduces this side and waits until the coupler has taken in both.
  void join(const FluidTraits& traits);
  /// Blocks until `arrived` is true; false if the run is over in good order. Throws if it ended otherwise, if
  /// the coupler is lost, or on an interruption (in the run on the second one: the first is passed on).
  bool wait(const std::function<bool()>& arrived);
  void count_step();
  void leave(ExitCode code, const std::string& reason) noexcept;

  /// Checks the head of a window, granted so long ago, and takes note of it; false if it belongs to another
  /// run.
  bool begin_window(const toryu_WindowHead& window, std::chrono::nanoseconds age);
  /// Whether a checkpoint is asked for; `turn` becomes that task.
  bool take_checkpoint(Turn& turn);
  void confirm_checkpoint(const std::function<void()>& write);
  /// The head of the answer to the window at hand.
  toryu_WindowHead answer() const { return wire::window(session_, window_); }
  /// Wall time since the window at hand was handed out [s]; to be asked for when it is answered. A side that
  /// is still at work then, as on its files, has it from the grant on: its work is no wait for messages.
  double compute_time();
  double waiting_time() const { return waiting_time_; }

  dds::Node& node() { return node_; }
  const std::uint64_t& coupler() const { return coupler_; }
  std::uint64_t session() const { return session_; }
  double reach() const { return traits_.reach; }
  bool windows_repeat() const { return windows_repeat_; }
  std::filesystem::path restart() const { return restart_.empty() ? restart_ : settings_.out / restart_; }
  void expect_particles(std::size_t count) { particles_ = count; }
  std::size_t particles() const { return particles_; }

 private:
  using Clock = std::chrono::steady_clock;
  void poll();
  void receive();
  void check_interruption();
  bool ours(const toryu_WindowHead& window) const;
  void handle_session(const toryu_Session& session);
  void check_coupler();
  void write_hello();
  void write_status(toryu_Activity activity, ExitCode code = ExitCode::done, const std::string& reason = "");

  LinkSettings settings_;
  toryu_Role role_;
  std::string process_;
  dds::Node node_;
  std::uint64_t coupler_ = dds::anybody;  // who took this side in, and alone is listened to then
  dds::Writer<toryu_Hello> hello_;
  dds::Writer<toryu_Status> status_;
  dds::Reader<toryu_Session> sessions_;
  dds::Reader<toryu_CheckpointRequest> checkpoint_requests_;
  dds::Writer<toryu_CheckpointReport> checkpoint_reports_;

  std::uint64_t session_ = 0;  // 0 until the coupler took this side in
  bool running_ = false;       // both sides were taken in
  bool over_ = false;
  bool left_ = false;
  FluidTraits traits_;  // the solid's link keeps the fluid's reach here
  double time_limit_;
  bool windows_repeat_ = false;
  bool checkpoints_ = false;       // whether the run writes any
  std::filesystem::path restart_;  // in the results folder
  bool interrupted_ = false;       // and the coupler is to hear of it
  Window window_{.number = 0};     // the window at hand; numbers start at 1
  std::size_t particles_ = 0;
  std::uint64_t steps_ = 0;

  bool coupler_came_ = false;
  std::uint64_t coupler_heartbeat_ = 0;
  std::string coupler_process_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point checked_ = start_, coupler_moved_ = start_;
  std::optional<Clock::time_point> lapsed_;  // since when the coupler's lease is over
  Clock::time_point status_sent_, granted_, handed_out_, answered_;
  double waiting_time_ = 0;
  Spin spin_;
};

}  // namespace toryu
