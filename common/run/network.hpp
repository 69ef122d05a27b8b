/// How the processes of a coupled run reach each other: on one machine, or over the network between hosts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/error/failure.hpp"

namespace toryu {

/// The range of ports of domain d starts at 7400 + 250 d; from 101 on it would reach into the ephemeral ones.
inline constexpr int last_domain = 100;

struct Network {
  std::vector<std::string> peers = {};  ///< all hosts of the run, this one among them; none: loopback alone
  std::string interface = {};           ///< name or address; empty: the one that leads to the peers
  std::optional<int> domain = {};       ///< sets the ports; nothing: it follows from the run's secret
  double lost_after = 3;                ///< silence after which a process that is not seen to run is lost [s]
  bool collected = false;               ///< whether what each host writes is brought to the coupler's results
  std::string secure = {};              ///< folder of the identities; empty: without DDS Security
};

/// The options as they were typed, empty where not given.
struct TypedNetwork {
  std::string peers, interface, domain, lost_after, secure;
  bool collected = false;
};

/// Adds what is wrong to `faults`.
Network read_network(const TypedNetwork& typed, std::vector<InputError>& faults);

}  // namespace toryu
