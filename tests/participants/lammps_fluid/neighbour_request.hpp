/// What LAMMPS knows of a list of neighbours that somebody wants. Debian's headers lack `neigh_request.h`;
/// these are the first members of its class, as LAMMPS of 29 September 2021 has them.
#pragma once

#include <stdexcept>

#include "lammps_headers.hpp"

namespace LAMMPS_NS {

class NeighRequest : protected Pointers {
 public:
  int index;
  void* requestor;
  int requestor_instance, id;
  int pair, fix, compute, command, neigh;  ///< which kind of class wants it: 1, the others 0
  int half, full;                          ///< one is 1: a pair once, or with either of its particles
};

}  // namespace LAMMPS_NS

namespace toryu::lammps_fluid {

/// Asks for a full list for a pair style, and ends where the members do not lie as above.
inline void request_full_list(LAMMPS_NS::Neighbor& neighbor, void* pair, int instance) {
  const int index = neighbor.request(pair, instance);  // which may move all requests
  auto& request = *neighbor.requests[index];
  if (request.requestor != pair || request.pair != 1 || request.fix != 0 || request.half != 1 ||
      request.full != 0)
    throw std::logic_error(
        "this LAMMPS is not that of 29 September 2021: its NeighRequest has another layout");
  request.half = 0;
  request.full = 1;
}

}  // namespace toryu::lammps_fluid
