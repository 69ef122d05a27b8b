#include "common/link/address.hpp"

#include <arpa/inet.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error/machine.hpp"

namespace toryu {

namespace {

constexpr const char* loopback = "127.0.0.1";

bool is_loopback(const std::string& address) {
  return address.starts_with("127.");
}

std::string text_of(const sockaddr_in& address) {
  char text[INET_ADDRSTRLEN];
  return inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
}

sockaddr_in address_of(const std::string& host) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  if (const int code = getaddrinfo(host.c_str(), nullptr, &wanted, &found); code != 0)
    throw BadInput(
        {{.place = "--peers " + host,
          .message = fmt::format("no IPv4 address of this host is known: {}", gai_strerror(code))}});
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof address);
  freeaddrinfo(found);
  return address;
}

/// The address that a datagram from here to `peer` bears; nothing is sent.
std::string source_towards(sockaddr_in peer) {
  const int made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  peer.sin_port = htons(7400);
  sockaddr_in own{};
  socklen_t size = sizeof own;
  const bool found = made >= 0 && connect(made, reinterpret_cast<sockaddr*>(&peer), sizeof peer) == 0 &&
                     getsockname(made, reinterpret_cast<sockaddr*>(&own), &size) == 0;
  const int reason = errno;
  if (made >= 0) close(made);
  if (found) return text_of(own);
  throw MachineFailure(fmt::format("no way leads to the host {} of --peers: {}; 'ip route get {}' shows why",
                                   text_of(peer), std::strerror(reason), text_of(peer)));
}

/// Throws BadInput that names the interfaces of this machine unless `wanted` is the name or address of one.
void require_interface(const std::string& wanted) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) throw MachineFailure("the network interfaces cannot be listed", errno);
  std::vector<std::string> names;
  bool is_there = false;
  for (const ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address{};
    std::memcpy(&address, each->ifa_addr, sizeof address);
    is_there = is_there || wanted == each->ifa_name || wanted == text_of(address);
    names.push_back(fmt::format("{} ({})", each->ifa_name, text_of(address)));
  }
  freeifaddrs(first);
  if (is_there) return;
  throw BadInput(
      {{.place = "--interface " + wanted,
        .message = fmt::format("this machine has no such network interface with an IPv4 address; it "
                               "has {}",
                               fmt::join(names, ", "))}});
}

}  // namespace

Addresses addresses(const Network& network) {
  if (network.peers.empty()) return {loopback, {loopback}};
  std::string own = loopback;
  Addresses found;
  for (const std::string& host : network.peers) {
    const sockaddr_in peer = address_of(host);
    const std::string source = source_towards(peer);
    if (is_loopback(own)) own = source;
    found.peers.push_back(text_of(peer));
  }
  for (std::string& peer : found.peers)
    if (is_loopback(peer)) peer = own;  // for Debian, the own name of a host is 127.0.1.1
  if (!network.interface.empty()) require_interface(network.interface);
  found.interface = network.interface.empty() ? own : network.interface;
  return found;
}

}  // namespace toryu
