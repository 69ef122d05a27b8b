#include "common/link/participant.hpp"

#include "common/error/ending.hpp"
#include "common/link/connection.hpp"

namespace toryu {

struct FluidLink::Connection : toryu::Connection {
  explicit Connection(const LinkSettings& settings)
      : toryu::Connection(settings, toryu_FLUID),
        interfaces(node(), wire::interface_to_fluid, coupler()),
        motions(node(), wire::motion_to_fluid, coupler()),
        loads(node(), wire::load_from_fluid) {}
  dds::Reader<toryu_Interface> interfaces;
  dds::Reader<toryu_Motion> motions;
  dds::Writer<toryu_Load> loads;
};

FluidLink::FluidLink(const LinkSettings& settings) : connection_(std::make_unique<Connection>(settings)) {}
FluidLink::~FluidLink() = default;

Interface FluidLink::join(const FluidTraits& traits) {
  connection_->join(traits);
  Interface interface;
  const bool came = connection_->wait([&] {
    bool ours = false;
    connection_->interfaces.take([&](const toryu_Interface& message) {
      ours = message.session_id == connection_->session();
      if (ours) interface = wire::interface_of(message);
    });
    return ours;
  });
  if (!came) throw PeerLost("coupler ended the run before it began");
  wire::check(interface, "coupler: interface");
  connection_->expect_particles(interface.size());
  return interface;
}

std::optional<FluidLink::Turn> FluidLink::next_turn() {
  Turn turn;
  const bool asked = connection_->wait([&] {
    bool ours = connection_->take_checkpoint(turn);
    if (ours) return true;
    connection_->motions.take([&](const toryu_Motion& message) {
      ours = connection_->begin_window(message.window, connection_->motions.age());
      if (ours) turn = {{wire::window(message.window)}, wire::motion(message)};
    });
    return ours;
  });
  if (!asked) return std::nullopt;
  if (turn.task == Task::window) wire::check(turn.motion, connection_->particles(), "coupler: motion");
  return turn;
}

void FluidLink::send(const InterfaceLoad& load, double time_step_limit, const Health& health) {
  toryu_Load message = wire::load(connection_->answer(), load);
  message.time_step_limit = time_step_limit;
  message.health = wire::health(health);
  message.health.compute_time = connection_->compute_time();
  connection_->loads.write(message);
}

bool FluidLink::windows_repeat() const {
  return connection_->windows_repeat();
}
std::filesystem::path FluidLink::restart() const {
  return connection_->restart();
}
void FluidLink::confirm_checkpoint(const std::function<void()>& write) {
  connection_->confirm_checkpoint(write);
}
void FluidLink::count_step() {
  connection_->count_step();
}
void FluidLink::leave(ExitCode code, const std::string& reason) noexcept {
  connection_->leave(code, reason);
}
void FluidLink::leave() noexcept {
  const auto [code, reason] = ending_of_exception();
  connection_->leave(code, reason);
}
double FluidLink::waiting_time() const {
  return connection_->waiting_time();
}

struct SolidLink::Connection : toryu::Connection {
  explicit Connection(const LinkSettings& settings)
      : toryu::Connection(settings, toryu_SOLID),
        interfaces(node(), wire::interface_from_solid),
        loads(node(), wire::load_to_solid, coupler()),
        motions(node(), wire::motion_from_solid) {}
  dds::Writer<toryu_Interface> interfaces;
  dds::Reader<toryu_Load> loads;
  dds::Writer<toryu_Motion> motions;
};

SolidLink::SolidLink(const LinkSettings& settings) : connection_(std::make_unique<Connection>(settings)) {}
SolidLink::~SolidLink() = default;

double SolidLink::join() {
  connection_->join({});
  return connection_->reach();
}

void SolidLink::register_interface(const Interface& interface, const InterfaceMotion& at_start) {
  connection_->expect_particles(interface.size());
  connection_->interfaces.write(wire::interface_message(connection_->session(), interface, at_start));
}

std::optional<SolidLink::Turn> SolidLink::next_turn() {
  Turn turn;
  const bool asked = connection_->wait([&] {
    bool ours = connection_->take_checkpoint(turn);
    if (ours) return true;
    connection_->loads.take([&](const toryu_Load& message) {
      ours = connection_->begin_window(message.window, connection_->loads.age());
      if (ours) turn = {{wire::window(message.window)}, wire::load(message)};
    });
    return ours;
  });
  if (!asked) return std::nullopt;
  if (turn.task == Task::window) wire::check(turn.load, connection_->particles(), "coupler: load");
  return turn;
}

void SolidLink::send(const InterfaceMotion& motion_at_end, const Vec& impulse_taken, const Health& health) {
  toryu_Motion message = wire::motion(connection_->answer(), motion_at_end);
  wire::set(message.impulse_taken, impulse_taken);
  message.health = wire::health(health);
  message.health.compute_time = connection_->compute_time();
  connection_->motions.write(message);
}

bool SolidLink::windows_repeat() const {
  return connection_->windows_repeat();
}
std::filesystem::path SolidLink::restart() const {
  return connection_->restart();
}
void SolidLink::confirm_checkpoint(const std::function<void()>& write) {
  connection_->confirm_checkpoint(write);
}
void SolidLink::count_step() {
  connection_->count_step();
}
void SolidLink::leave(ExitCode code, const std::string& reason) noexcept {
  connection_->leave(code, reason);
}
void SolidLink::leave() noexcept {
  const auto [code, reason] = ending_of_exception();
  connection_->leave(code, reason);
}
double SolidLink::waiting_time() const {
  return connection_->waiting_time();
}

}  // namespace toryu
