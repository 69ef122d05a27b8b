#include "common/link/connection.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error/ending.hpp"
#include "common/error/failure.hpp"
#include "common/error/printable.hpp"
#include "common/link/process.hpp"
#include "common/link/run_secret.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"

namespace toryu {

namespace {

using namespace std::chrono_literals;
constexpr auto longest_sleep = 100ms;  // between looks at interruptions and the peer's lease
constexpr auto status_interval = 200ms;
using Seconds = std::chrono::duration<double>;

bool is_over_hosts(const LinkSettings& settings) {
  return !settings.network.peers.empty();
}

/// Over hosts a secret that a participant made for itself would leave it alone.
dds::Rendezvous place_of(const LinkSettings& settings) {
  if (is_over_hosts(settings) && !has_run_secret(settings.out))
    throw BadInput(
        {{.place = "--peers",
          .message = fmt::format("the secret of the run is not in {}: the coupler makes it in its "
                                 "results folder when it starts; copy that file here for its owner "
                                 "alone ('scp -p')",
                                 (settings.out / "run.secret").string())}});
  return dds::rendezvous(settings.out, settings.network);
}

}  // namespace

Connection::Connection(const LinkSettings& settings, toryu_Role role)
    : settings_(settings),
      role_(role),
      process_(own_process()),
      node_(place_of(settings), {settings.role, role == toryu_FLUID ? "fluid" : "solid"}),
      hello_(node_, role == toryu_FLUID ? wire::hello_from_fluid : wire::hello_from_solid),
      status_(node_, role == toryu_FLUID ? wire::status_from_fluid : wire::status_from_solid),
      sessions_(node_, wire::session, coupler_),
      checkpoint_requests_(node_, wire::checkpoint_request, coupler_),
      checkpoint_reports_(node_,
                          role == toryu_FLUID ? wire::checkpoint_from_fluid : wire::checkpoint_from_solid),
      time_limit_(settings.time_limit) {}

Connection::~Connection() {
  // A participant that goes without a word would look dead only after its lease has lapsed.
  if (!over_ && !left_) leave(ExitCode::bug, "ended before the run was over");
  if (is_over_hosts(settings_)) forget_run_secret(settings_.out);  // this copy; the coupler forgets its own
}

void Connection::write_hello() {
  std::string units = wire::units;
  toryu_Hello message{};
  message.session_id = session_;
  message.role = role_;
  message.program = settings_.role.data();
  message.version = settings_.version.data();
  message.process = process_.data();
  message.protocol = wire::protocol;
  message.case_hash = settings_.case_hash;
  message.units = units.data();
  message.dimension = dim;
  message.reach = traits_.reach;
  message.time_step_limit = traits_.time_step_limit;
  message.density = traits_.density;
  message.sound_speed = traits_.sound_speed;
  message.spacing = traits_.spacing;
  message.can_repeat = settings_.can_repeat;
  message.can_checkpoint = settings_.can_checkpoint;
  message.used_case = settings_.used_case.data();
  hello_.write(message);
}

void Connection::write_status(toryu_Activity activity, ExitCode code, const std::string& reason) {
  std::string text = reason;
  toryu_Status message{};
  message.session_id = session_;
  message.window = window_.number;
  message.steps = steps_;
  message.interrupted = interrupted_;
  message.activity = activity;
  message.exit_code = static_cast<std::uint32_t>(code);
  message.reason = text.data();
  status_.write(message);
  status_sent_ = Clock::now();
}

void Connection::join(const FluidTraits& traits) {
  traits_ = traits;
  write_hello();
  log::info("waiting for the coupler, at most {} s", time_limit_);
  if (!wait([this] { return running_; })) throw PeerLost("coupler ended the run before it began");
}

void Connection::handle_session(const toryu_Session& session) {
  const std::uint64_t taken_in = role_ == toryu_FLUID ? session.fluid : session.solid;
  if (session_ != 0 && session.session_id != session_) {
    log::warn("refused a message of coupler session {:x}: this run is session {:x}", session.session_id,
              session_);
    return;
  }
  if (!coupler_came_ || session.heartbeat != coupler_heartbeat_) coupler_moved_ = Clock::now();
  coupler_came_ = true;
  coupler_process_ = session.process;
  coupler_heartbeat_ = session.heartbeat;
  if (session.phase == toryu_OVER) {
    over_ = true;
    session_ = session.session_id;
    write_status(toryu_LEFT);  // so that the coupler knows that this side knows
    status_.flush(1s);
    const auto code = static_cast<ExitCode>(session.exit_code);
    if (code != ExitCode::done) throw_ending({code, printable(session.reason)});
    return;
  }
  if (taken_in != 0 && taken_in != node_.id()) {
    left_ = true;
    throw BadInput(
        {{.place = settings_.role, .message = "another process has this part in the run already"}});
  }
  if (taken_in == node_.id() && session_ == 0) {
    session_ = session.session_id;
    coupler_ = session.sender;
    time_limit_ = session.time_limit;
    write_hello();
  }
  if (session_ != 0 && session.phase == toryu_RUNNING && !running_) {
    running_ = true;
    traits_.reach = session.reach;
    windows_repeat_ = session.windows_repeat;
    checkpoints_ = session.checkpoints;
    restart_ = session.restart;
  }
}

void Connection::check_coupler() {
  const auto now = Clock::now();
  if (now - checked_ < longest_sleep) return;
  if (now - checked_ > 1s) coupler_moved_ = now;  // silence counts only while this side listened
  checked_ = now;
  node_.explain_silence();  // a coupler of another protocol never comes
  node_.introductions().hear();
  if (!coupler_came_) {
    if (const auto* refusal = node_.introductions().refusal_of("coupler"))
      if (now - refusal->since > Seconds(settings_.network.lost_after))
        throw BadInput({{.place = "--secure", .message = refusal->reason}});
    if (now - start_ > Seconds(time_limit_))
      throw PeerLost(fmt::format("coupler did not come within {} s", time_limit_));
    return;
  }
  if (sessions_.live_writers() > 0)
    lapsed_ = {};
  else if (!lapsed_)
    lapsed_ = now;
  const ProcessState state = state_of(coupler_process_);
  const bool lapsed =
      lapsed_ && now - *lapsed_ > dds::grace(settings_.network.lost_after) && state != ProcessState::runs;
  if (lapsed || state == ProcessState::gone) {
    receive();  // its last words say more, and may have come since they were looked for
    if (over_) return;
    throw PeerLost(fmt::format("coupler {}: no sign of life in window {}", words_of_loss(coupler_process_),
                               window_.number));
  }
  if (now - coupler_moved_ > Seconds(time_limit_))
    throw PeerLost(
        fmt::format("coupler hangs: it has not moved for {} s in window {}", time_limit_, window_.number));
}

void Connection::receive() {
  while (!over_ && sessions_.take([this](const toryu_Session& session) { handle_session(session); })) {
  }
}

/// Hears what the coupler says of the run, and looks after it and after interruptions.
void Connection::poll() {
  receive();
  if (over_) return;
  check_interruption();
  check_coupler();
}

/// Before the run an interruption ends this side, within it the coupler ends it for all.
void Connection::check_interruption() {
  if (!running_) throw_if_interrupted();
  throw_if_interrupted_again();
  if (interrupted_ || !interruption_requested()) return;
  interrupted_ = true;
  status_sent_ = {};  // at once
  log::info("interrupted: the coupler is asked to end the run{}; a second signal ends this process at once",
            checkpoints_ ? " with a checkpoint" : "");
}

bool Connection::wait(const std::function<bool()>& arrived) {
  const auto start = Clock::now();
  SpinningWait waiting(spin_);
  bool has_arrived = arrived();
  const bool late = has_arrived;
  while (!has_arrived) {
    poll();
    if (over_) break;
    if (Clock::now() - status_sent_ > status_interval) write_status(toryu_WAITING);
    node_.wait(longest_sleep, waiting);
    has_arrived = arrived();
  }
  const auto now = Clock::now();
  handed_out_ = late ? std::clamp(granted_, answered_, now) : now;
  waiting_time_ += Seconds(now - start).count();
  return has_arrived;
}

void Connection::count_step() {
  ++steps_;
  if (over_ || Clock::now() - status_sent_ < status_interval) return;
  poll();
  if (!over_) write_status(toryu_WORKING);
}

bool Connection::ours(const toryu_WindowHead& window) const {
  if (window.session_id == session_) return true;
  log::warn("refused window {} of coupler session {:x}: this run is session {:x}", window.number,
            window.session_id, session_);
  return false;
}

bool Connection::begin_window(const toryu_WindowHead& window, std::chrono::nanoseconds age) {
  if (!ours(window)) return false;
  if (window_.number == 0 && !restart_.empty()) window_.number = window.number - 1;
  const bool again = windows_repeat_ && window.number == window_.number;
  const Window expected = again ? Window{.number = window_.number, .iteration = window_.iteration + 1}
                                : Window{.number = window_.number + 1};
  wire::check(window, expected, "coupler");
  window_ = wire::window(window);
  granted_ = Clock::now() - age;
  return true;
}

bool Connection::take_checkpoint(Turn& turn) {
  bool asked = false;
  checkpoint_requests_.take([&](const toryu_CheckpointRequest& request) {
    asked = ours(request.window);
    if (!asked) return;
    wire::check(request.window, window_, "coupler");
    static_cast<Window&>(turn) = window_;
    turn.task = Task::checkpoint;
    turn.checkpoint = settings_.out / request.folder;
  });
  // The coupler made it where it is. What fails here fails again, in words, where the part is written.
  std::error_code ignored;
  if (asked && settings_.network.collected) std::filesystem::create_directories(turn.checkpoint, ignored);
  return asked;
}

void Connection::confirm_checkpoint(const std::function<void()>& write) {
  std::string failure;
  try {
    write();
  } catch (const std::exception& reason) {
    failure = reason.what();
  }
  checkpoint_reports_.write(wire::report_of_checkpoint(answer(), failure));
}

double Connection::compute_time() {
  answered_ = Clock::now();
  return Seconds(answered_ - handed_out_).count();
}

void Connection::leave(ExitCode code, const std::string& reason) noexcept {
  if (over_ || left_) return;
  left_ = true;
  try {
    write_status(toryu_LEFT, code, reason);
    if (code != ExitCode::peer_lost) status_.flush(1s);
  } catch (const std::exception& failure) {
    log::warn("the coupler could not be told of the end: {}", failure.what());
  }
}

}  // namespace toryu
