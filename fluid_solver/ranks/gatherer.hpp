/// Values of some items of each rank, brought to rank 0: who brings which is told once.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "common/sph/points.hpp"

namespace toryu::fluid {

class Gatherer {
 public:
  Gatherer() = default;
  /// The k-th of `items` of this rank goes to `places`[k] on rank 0.
  Gatherer(MPI_Comm communicator, std::vector<std::uint32_t> items, const std::vector<std::uint32_t>& places);

  /// On rank 0 `whole`[n][place] becomes `part`[n][item] of the rank that brings it. They may be the same.
  void gather(const std::vector<const Field*>& part, const std::vector<Field*>& whole) const;
  /// On rank 0: of the items of all ranks, one rank after the other.
  std::vector<std::uint32_t>& places() { return places_; }

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
  std::vector<std::uint32_t> items_ = {};
  std::vector<int> counts_ = {};  ///< of each rank; on rank 0
  std::vector<std::uint32_t> places_ = {};
};

}  // namespace toryu::fluid
