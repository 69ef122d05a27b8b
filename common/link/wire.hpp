/// Between the messages of the wire and the structures of the public interface, with the checks that every
/// message undergoes before it is used.
#pragma once

#include <array>
#include <string>

#include "common/link/dds.hpp"
#include "common/link/participant.hpp"

namespace toryu::wire {

/// Raised whenever a message changes its meaning; processes of different protocols refuse each other.
inline constexpr std::uint32_t protocol = 7;
inline constexpr const char* units = "SI";

// A topic has one writer's role; what passes through the coupler has a topic on each of its sides.
inline constexpr const char* hello_from_fluid = "toryu/hello_from_fluid";
inline constexpr const char* hello_from_solid = "toryu/hello_from_solid";
inline constexpr const char* session = "toryu/session";
inline constexpr const char* status_from_fluid = "toryu/status_from_fluid";
inline constexpr const char* status_from_solid = "toryu/status_from_solid";
inline constexpr const char* interface_from_solid = "toryu/interface_from_solid";
inline constexpr const char* interface_to_fluid = "toryu/interface_to_fluid";
inline constexpr const char* motion_from_solid = "toryu/motion_from_solid";
inline constexpr const char* motion_to_fluid = "toryu/motion_to_fluid";
inline constexpr const char* load_from_fluid = "toryu/load_from_fluid";
inline constexpr const char* load_to_solid = "toryu/load_to_solid";
inline constexpr const char* checkpoint_request = "toryu/checkpoint_request";
inline constexpr const char* checkpoint_from_fluid = "toryu/checkpoint_from_fluid";
inline constexpr const char* checkpoint_from_solid = "toryu/checkpoint_from_solid";

// To the wire: the message points into the structure, which must outlive it.
toryu_WindowHead window(std::uint64_t session_id, const Window& window);
toryu_HealthReport health(const Health& health);
toryu_Interface interface_message(std::uint64_t session_id, const Interface& interface,
                                  const InterfaceMotion& start);
toryu_Motion motion(const toryu_WindowHead& window, const InterfaceMotion& motion);
toryu_Load load(const toryu_WindowHead& window, const InterfaceLoad& load);
toryu_CheckpointRequest request_of_checkpoint(const toryu_WindowHead& window, const std::string& folder);
toryu_CheckpointReport report_of_checkpoint(const toryu_WindowHead& window, const std::string& failure);

// From the wire.
Window window(const toryu_WindowHead& message);
Health health(const toryu_HealthReport& message);
Vec vector(const double (&components)[3]);
Interface interface_of(const toryu_Interface& message);
InterfaceMotion start_of(const toryu_Interface& message);
InterfaceMotion motion(const toryu_Motion& message);
InterfaceLoad load(const toryu_Load& message);
void set(double (&components)[3], const Vec& value);

/// Each throws PeerLost if a count is not that of `particles`, PhysicsFailure if a value is not finite.
/// `sender` begins the message: "solid_solver: window 12".
void check(const Interface& interface, const std::string& sender);
void check(const InterfaceMotion& motion, std::size_t particles, const std::string& sender);
void check(const InterfaceLoad& load, std::size_t particles, const std::string& sender);
void check(const Health& health, const std::string& sender);
/// Throws PeerLost if the answer is not to `expected`, PhysicsFailure if its time or step is not finite.
void check(const toryu_WindowHead& window, const Window& expected, const std::string& sender);

}  // namespace toryu::wire
