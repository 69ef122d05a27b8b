#include "common/run/network.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace toryu {

namespace {

constexpr double shortest_silence = 1;    // [s]: twice the lease of a writer
constexpr double longest_silence = 3600;  // [s]

/// The whole text as a number within the limits.
template <class Number>
std::optional<Number> number_within(const std::string& text, Number least, Number most) {
  Number number{};
  const auto end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || !(number >= least && number <= most)) return std::nullopt;
  return number;
}

/// What names of hosts and interfaces are made of.
bool is_name(const std::string& text) {
  const auto fits = [](unsigned char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("-._").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !text.empty() && text.front() != '-' && std::all_of(text.begin(), text.end(), fits);
}

}  // namespace

Network read_network(const TypedNetwork& typed, std::vector<InputError>& faults) {
  Network network;
  std::istringstream list(typed.peers + (typed.peers.ends_with(',') ? "," : ""));
  for (std::string host; std::getline(list, host, ',');) network.peers.push_back(host);
  if (!std::all_of(network.peers.begin(), network.peers.end(), is_name))
    faults.push_back({.place = "--peers " + typed.peers,
                      .message = "must be names or IPv4 addresses of hosts, with commas between them"});
  network.interface = typed.interface;
  if (!typed.interface.empty() && !is_name(typed.interface))
    faults.push_back({.place = "--interface " + typed.interface,
                      .message = "must be the name or the IPv4 address of a network interface"});
  if (!typed.interface.empty() && typed.peers.empty())
    faults.push_back(
        {.place = "--interface " + typed.interface,
         .message = "without --peers a run is on this machine alone, and takes no other than lo"});
  if (!typed.domain.empty() && !(network.domain = number_within(typed.domain, 1, last_domain)))
    faults.push_back({.place = "--domain " + typed.domain,
                      .message = fmt::format("must be an integer of 1 to {}", last_domain)});
  network.collected = typed.collected;
  network.secure = typed.secure;
  if (typed.lost_after.empty()) return network;
  if (const auto limit = number_within(typed.lost_after, shortest_silence, longest_silence))
    network.lost_after = *limit;
  else
    faults.push_back(
        {.place = "--lost-after " + typed.lost_after,
         .message = fmt::format("must be a number of {:g} to {:g} [s]", shortest_silence, longest_silence)});
  return network;
}

}  // namespace toryu
