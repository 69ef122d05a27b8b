/// Messages of any length from each rank to each.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace toryu::fluid {

template <class Value>
MPI_Datatype mpi_type();
template <>
inline MPI_Datatype mpi_type<double>() {
  return MPI_DOUBLE;
}
template <>
inline MPI_Datatype mpi_type<std::uint32_t>() {
  return MPI_UINT32_T;
}

/// Sends `messages`[r] to rank r and returns what each rank has sent to this one.
template <class Value>
std::vector<std::vector<Value>> all_to_all(const std::vector<std::vector<Value>>& messages,
                                           MPI_Comm communicator) {
  const std::size_t size = messages.size();
  std::vector<int> sizes(size), sizes_here(size);
  for (std::size_t r = 0; r < size; ++r) sizes[r] = static_cast<int>(messages[r].size());
  MPI_Alltoall(sizes.data(), 1, MPI_INT, sizes_here.data(), 1, MPI_INT, communicator);
  std::vector<std::vector<Value>> received(size);
  std::vector<MPI_Request> requests;
  for (std::size_t r = 0; r < size; ++r)
    if (sizes_here[r] > 0) {
      received[r].resize(static_cast<std::size_t>(sizes_here[r]));
      MPI_Irecv(received[r].data(), sizes_here[r], mpi_type<Value>(), static_cast<int>(r), 0, communicator,
                &requests.emplace_back());
    }
  for (std::size_t r = 0; r < size; ++r)
    if (sizes[r] > 0)
      MPI_Isend(messages[r].data(), sizes[r], mpi_type<Value>(), static_cast<int>(r), 0, communicator,
                &requests.emplace_back());
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return received;
}

}  // namespace toryu::fluid
