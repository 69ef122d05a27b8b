/// Addresses of the hosts of a run, and the one by which they know this host.
#pragma once

#include <string>

#include "common/run/network.hpp"

namespace toryu {

/// Where this process is on the network, and where it looks for the others; IPv4 addresses.
struct Addresses {
  std::string interface;  ///< name or address of the one interface that is used
  std::vector<std::string> peers;
};

/// Loopback alone without peers. Else the interface is the one that was given, or that by which this host
/// reaches the first peer that it does not reach by loopback. Throws BadInput for a host that nobody knows
/// and an interface that is not there, MachineFailure where no way leads to one.
Addresses addresses(const Network& network);

}  // namespace toryu
